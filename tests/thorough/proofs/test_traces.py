"""What traces break, so far and in all, and which claims come about: the Python says what is extracted from the theory
says (`proofs/traces/`)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

import pytest

from sleec_runtime.evaluation.trace_violations import Requirement, claim_holds, violations, violations_so_far
from sleec_runtime.model import (
    RELATIONS,
    Atom,
    Calculation,
    Clause,
    Lasting,
    MeasureRef,
    leaves,
    literals,
    relation_name,
)
from sleec_verify.certificates.theory.numbered_traces import NumberedTraces
from sleec_verify.certificates.theory.oracle import NoAnswer, answers
from tests.support.random_traces import Case, random_cases

# Whichever test comes first may have to compile the theory.
pytestmark = pytest.mark.timeout(600)


def compare(oracle: Path, cases: Iterable[Case], at_once: int = 200) -> Counter[str]:
    """Compare all traces of all cases; returns how often each feature has been compared."""
    seen: Counter[str] = Counter()
    left = iter(cases)
    while chunk := list(islice(left, at_once)):
        numbered, questions = [], []
        for case in chunk:
            one = NumberedTraces(case.ruleset, case.untimed)
            claims = [one.claims(claim) for claim in case.claims]
            numbered.append(one)
            questions += [one.line, *(q for trace in case.traces for q in (one.trace(trace), *claims))]
        said = iter(answers(oracle, questions))
        for case, one in zip(chunk, numbered):
            assert next(said) == "ok"
            for trace in case.traces:
                whole, so_far = next(said).split(";")
                where = f"{case} at {trace}"
                found = list(map(tuple, violations(case.ruleset, trace, case.untimed)))
                assert found == one.broken(whole, trace), where
                early = list(map(tuple, violations_so_far(case.ruleset, trace, case.untimed)))
                assert early == one.broken(so_far, trace), where
                holds = [claim_holds(claim, case.ruleset, trace, case.untimed) for claim in case.claims]
                assert holds == [next(said) == "yes" for _ in case.claims], where
                for law in one.laws:
                    times = {t for other, t in found if other is law}, {t for other, t in early if other is law}
                    verdict = "kept" if not times[0] else "broken" if times[1] else "open"
                    seen[f"{kind(law)} {verdict}"] += 1
                seen.update(f"claim {'holds' if one else 'does not hold'}" for one in holds)
            seen.update(features(case))
    return seen


def kind(law: Requirement) -> str:
    return relation_name(law) if isinstance(law, RELATIONS) else type(law).__name__.lower()


def features(case: Case) -> Iterator[str]:
    """What of the language a case uses, besides its laws."""
    yield case.untimed
    yield case.ruleset.reading
    for rule in case.ruleset.rules:
        if rule.guard is not None:
            yield "guard"
        if len(rule.hedges) > 1:
            yield "two hedges"
        for clause in rule.clauses():
            yield from features_of(clause)
    for claim in case.claims:
        yield claim.form
        yield f"{claim.kind} of {len(claim.responses)} responses"
        if claim.condition is not None:
            yield "claim with a condition"
        if claim.meanwhile is not None:
            yield "meanwhile"
        for response in claim.responses:
            yield from (f"{feature} in a claim" for feature in features_of(response))
    for trace in case.traces:
        yield f"{len(trace.instants)} instants"
    lasting = [s for s in case.ruleset.statements if isinstance(s, Lasting)]
    for law in lasting:
        if law.duration is not None and law.duration.measures:
            yield "measured duration"
        if law.end_condition is not None:
            yield "until with a condition"


def features_of(clause: Clause) -> Iterator[str]:
    if clause.hedges:
        yield "chain in a chain"
    if not clause.obligations:
        yield "hedge without a response"
    if len(clause.obligations) > 1:
        yield "two obligations"
    if clause.condition is not None:
        yield from (leaf.kind if isinstance(leaf, Atom) else "comparison" for leaf in leaves(clause.condition))
    for obligation in clause.obligations:
        timing = obligation.timing
        sign = "not " if obligation.negated else ""
        if timing is None or timing.window is None:
            yield f"{sign}untimed"
        elif timing.window.end is None:
            yield f"{sign}eventually"
        else:
            yield f"{sign}{'within' if timing.window.start is None else 'from to'}"
            if isinstance(timing.window.end.amount, (MeasureRef, Calculation)):
                yield f"{sign}measured {type(timing.window.end.amount).__name__}"
        if timing is not None:
            for word, alternative in (("otherwise", timing.otherwise), ("else", timing.instead)):
                if alternative is not None:
                    yield f"{word} after {'no window' if timing.window is None else 'a window'}"
                    if alternative.hedges:
                        yield f"hedges in {word}"
                    if any(o.timing is not None for o in literals(alternative)):
                        yield f"time in {word}"


LAWS = (
    *("rule", "exclusive", "never", "assume", "witness", "equal", "mutualExclusive", "happenBefore"),
    *(f"measure {name}" for name in ("imply", "iff", "mutualExclusive", "opposite", "invariant")),
    *("causation", "includes", "forbid", "when ... until", "when ... for"),
)
NEVER_OPEN = {"happenBefore", "includes", "when ... for", *(law for law in LAWS if law.startswith("measure"))}
"""What is broken at now whatever else occurs: events that are missing do not mend it."""

SIGNS = ("", "not ")
EVERY = {
    *(f"{law} kept" for law in LAWS),
    *(f"{law} broken" for law in LAWS),
    *(f"{law} open" for law in LAWS if law not in {*NEVER_OPEN, "mutualExclusive", "forbid", "exclusive"}),
    *("claim holds", "claim does not hold", "at", "eventually", "cascade", "priority", "guard", "two hedges"),
    *("exists", "when", "claim with a condition", "meanwhile", "comparison", "condition", "trigger"),
    *(f"{name} of {count} responses" for name in ("concern", "purpose") for count in range(3)),
    *(f"{count} instants" for count in range(6)),
    *("measured duration", "until with a condition", "chain in a chain", "hedge without a response", "two obligations"),
    *(f"{sign}{window}" for sign in SIGNS for window in ("untimed", "eventually", "within", "from to")),
    *(f"{sign}measured {amount}" for sign in SIGNS for amount in ("MeasureRef", "Calculation")),
    *(f"{word} after {what}" for word in ("otherwise", "else") for what in ("no window", "a window")),
    *(f"{what} in {word}" for word in ("otherwise", "else") for what in ("hedges", "time")),
    *("within in a claim", "otherwise after a window in a claim", "chain in a chain in a claim"),
}


@pytest.mark.parametrize("seed", range(2))
def test_4_000_random_traces(oracle: Path, seed: int) -> None:
    """Each feature of the semantics is compared at least five times."""
    seen = compare(oracle, random_cases(seed, 1_000))
    assert {feature for feature in EVERY if seen[feature] < 5} == set()


@pytest.mark.long
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("seed", range(100, 110))
def test_200_000_random_traces(oracle: Path, seed: int) -> None:
    compare(oracle, random_cases(seed, 5_000))


def test_what_is_no_question_about_traces_is_not_answered(oracle: Path) -> None:
    line = "laws cascade at 1 rule 1 1 1 2 w s 0 s 3 0 0"
    assert answers(oracle, [line, "trace 1 0 1 1 0 0", "claims 0"])[1:] == ["broken 0.0; so-far ", "yes"]
    for question in ("trace", "trace 1", "trace 1 0 1 0 0 0", "trace 0 1", "claims", "claims 1 1", "claims 1 1 o 1 0"):
        with pytest.raises(NoAnswer, match="UNREADABLE"):
            answers(oracle, [line, question])
    for laws in ("laws", "laws both at 0", "laws cascade now 0", f"{line} 0", "laws cascade at 1 law 1", "trace 0"):
        with pytest.raises(NoAnswer, match="UNREADABLE"):
            answers(oracle, [laws])
