"""The traces of certificates, replayed by the evaluator that is extracted from the theory (`proofs/traces/`)."""

from __future__ import annotations

import random
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from sleec_runtime.language import load
from sleec_runtime.model import Ruleset
from sleec_verify.certificates.certification import rebuild
from sleec_verify.certificates.theory.oracle import NoAnswer
from sleec_verify.certificates.theory.trace_oracle import OracleEvaluator
from sleec_verify.certificates.trace_evidence import CheckTrace
from sleec_verify.certificates.trace_replay import TraceReplay
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.replay.traces import replay_found
from tests.support.studies import each_study
from tests.support.timed_strategies import timed_ruleset

# Whichever test comes first may have to compile the theory.
pytestmark = pytest.mark.timeout(600)


def traces_of(ruleset: Ruleset, untimed: Untimed = "at") -> list[CheckTrace]:
    return [trace for one in rebuild(ruleset, None, untimed) for trace in one.traces]


@pytest.mark.slow
@each_study
def test_both_evaluators_confirm_the_traces_of_studies(oracle: Path, path: Path) -> None:
    with OracleEvaluator(oracle) as evaluator:
        replay = TraceReplay(evaluator)
        assert [str(trace) for trace in traces_of(load(path)) if replay.rejected(trace)] == []
        assert not replay.result().reasons


def altered(trace: CheckTrace, draw: random.Random) -> CheckTrace:
    """The same claim of another trace: an event more or less, a condition negated, or a later time."""
    instants = list(trace.found.instants)
    place = draw.randrange(len(instants))
    time, events, values = instants[place]
    events = events ^ {draw.choice(sorted({*trace.index.ruleset.triggers, *events}))}
    flags = [name for name, value in values.items() if isinstance(value, bool)]
    if flags and draw.random() < 0.5:
        name = draw.choice(flags)
        values = {**values, name: not values[name]}
    instants[place] = (time, events, values)
    if draw.random() < 0.5:
        instants[place + 1 :] = [(t + 3, e, v) for t, e, v in instants[place + 1 :]]
    return replace(trace, found=trace.found._replace(instants=tuple(instants)))


def test_both_evaluators_agree_on_traces_and_on_altered_ones(oracle: Path) -> None:
    draw = random.Random(0)
    answers: Counter[tuple[str, bool]] = Counter()
    with OracleEvaluator(oracle) as evaluator:
        for seed in sorted({*range(20)} - {3, 8, 9, 11}):  # these take long
            for trace in traces_of(timed_ruleset(seed), "eventually" if seed % 2 else "at"):
                assert replay_found(trace.index, trace.found, evaluator), str(trace)
                for _ in range(3):
                    other = altered(trace, draw)
                    here = replay_found(other.index, other.found)
                    assert here == replay_found(other.index, other.found, evaluator), str(other.json())
                    answers[trace.found.shows, here] += 1
    for shows in ("violation", "trigger", "conflict"):
        assert answers[shows, True] > 3
        assert answers[shows, False] > 3


def test_an_oracle_that_does_not_answer_is_a_reason(tmp_path: Path) -> None:
    program = tmp_path / "oracle"
    program.write_text("#!/bin/sh\nwhile read word; do echo yes; done\n")
    program.chmod(0o755)
    (trace, *_) = traces_of(timed_ruleset(0))
    with OracleEvaluator(program) as evaluator:
        with pytest.raises(NoAnswer):
            replay_found(trace.index, trace.found, evaluator)
        replay = TraceReplay(evaluator)
        assert replay.rejected(trace) is None
        assert replay.result().reasons == {"the oracle did not answer: yes": 1}
