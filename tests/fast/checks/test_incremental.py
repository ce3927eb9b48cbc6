"""After a change, only what depends on it is checked again, with the results of a check of the whole text."""

from __future__ import annotations

import pytest

from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import Checking, run_checks
from sleec_verify.checks.incremental.checking import IncrementalChecks
from tests.support.incremental import assert_equal_to_whole_checks, without_seconds
from tests.support.text_edits import edited_texts


@pytest.mark.parametrize("seed", range(15))
def test_random_edits(seed: int) -> None:
    assert_equal_to_whole_checks(edited_texts(seed, edits=4, timed=False))


def test_a_change_of_one_rule_asks_about_few_rules(monkeypatch: pytest.MonkeyPatch) -> None:
    text = random_rules(100)
    before, after = parse(text), parse(text.replace("RULE r50\n", "RULE r50\n// a comment\n").replace("r7\n", "r7a\n"))
    checks = IncrementalChecks()
    checks.results(before)
    asked: list[int] = []
    original = Checking.__init__

    def noting(self: Checking, ruleset: Ruleset, **options: object) -> None:
        asked.append(len(ruleset.rules))
        original(self, ruleset, **options)  # type: ignore[arg-type]

    with monkeypatch.context() as patch:
        patch.setattr(Checking, "__init__", noting)
        results = checks.results(after)
    whole, *parts = asked
    assert whole == 100
    assert parts
    assert max(parts) <= 25
    assert without_seconds(results) == without_seconds(run_checks(after))


def test_an_undecided_text_is_checked_as_a_whole() -> None:
    text = "WHEN A THEN B\n"
    undecided = "".join(f"EXCLUSIVE {', '.join(f'X{i}_{k}' for k in range(3))}\n" for i in range(3)) + text
    assert_equal_to_whole_checks([text, undecided, text + "WHEN C THEN D\n", undecided + "WHEN C THEN NOT X0_1\n"])


def test_checks_that_are_interrupted_keep_the_text_before() -> None:
    class Stopped(Exception):
        pass

    def stop() -> None:
        raise Stopped

    checks = IncrementalChecks()
    assert not checks.is_prepared
    checks.results(parse("WHEN A THEN B\nWHEN A THEN C\n"))
    with pytest.raises(Stopped):
        checks.results(parse("WHEN A THEN NOT B\nWHEN A THEN B\n"), stop)
    assert checks.is_prepared
    after = parse("WHEN A THEN B\nWHEN A THEN NOT B\n")
    assert without_seconds(checks.results(after)) == without_seconds(run_checks(after))
