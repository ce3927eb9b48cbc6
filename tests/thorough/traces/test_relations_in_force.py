"""Relations that a history begins restrict the situation of a conflict: `when ... for` and `when ... until`."""

from __future__ import annotations

import pytest

from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Unknown
from tests.support.timed_strategies import timed_ruleset


def test_the_values_that_a_relation_of_the_history_requires_are_shown() -> None:
    (conflict,) = run_checks(timed_ruleset(77), ["conflict"])
    shown = [finding.timeline.moments for finding in conflict.findings if finding.timeline is not None]
    begun = [
        moments
        for moments in shown
        if any(moment.events == ("A",) and moment.conditions["m"] for moment in moments[:-1])
    ]
    # After `A` with `m`, the relation requires `m` for three seconds.
    assert begun
    assert all(moments[-1].conditions["m"] for moments in begun if moments[-1].time - moments[0].time < 3)


@pytest.mark.slow
def test_the_replay_confirms_each_conflict() -> None:
    count = 0
    for seed in range(400):
        ruleset = timed_ruleset(seed)
        if not any(word in ruleset.source.text for word in (" for ", " until ")):
            continue
        (conflict,) = run_checks(ruleset, ["conflict"])
        count += bool(conflict.findings)
        assert not (isinstance(conflict.verdict, Unknown) and "bug" in conflict.verdict.why), seed
    assert count > 5
