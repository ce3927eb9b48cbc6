"""Assumptions that leave no situation at all."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from sleec_runtime.model import MeasureRelation
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.encoding.budget import Undecided
from sleec_verify.query.question import Question, is_possible
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.traces.partition import without
from sleec_verify.wording.phrases import listed
from sleec_verify.wording.sentence import sentence


def _contradictory(index: RulesetIndex) -> Iterator[Finding]:
    """Unsatisfiable exactly when no situation is possible: the assumptions, and the relations between measures. A model
    is a possible situation."""
    index = index.once(_facts)
    if not index.assumptions or is_possible(index):
        return
    needed, minimal = _at_odds(index)
    spans = [index.assumptions[position].span for position in needed]
    place = index.ruleset.source.place
    lines = [str(place(span).line) for span in spans]
    note = sentence(
        "no situation remains, so no rule ever applies, and no other result about this ruleset means anything"
    )
    yield ASSUMPTIONS.finding(
        sentence("this assumption can never be true")
        if len(spans) == 1
        else sentence("the assumptions in lines {lines} contradict each other", lines=listed(lines)),
        spans[0],
        note=note
        if minimal
        else sentence("{note}; some of these assumptions may contradict each other without the rest", note=note),
        related=tuple((span, sentence("part of the contradiction")) for span in spans[1:]),
    )


def contradict_each_other(index: RulesetIndex) -> bool:
    """Whether the assumptions, with the relations between measures, leave no situation. False if this is undecided."""
    facts = index.once(_facts)
    with suppress(Undecided):
        return bool(facts.assumptions) and not is_possible(facts)
    return False


def _facts(index: RulesetIndex) -> RulesetIndex:
    """The ruleset with its relations between measures as assumptions, without its rules if there are any."""
    if any(isinstance(statement, MeasureRelation) for statement in index.ruleset.statements):
        return without(index, index.rules, ())
    return index


def _at_odds(index: RulesetIndex) -> tuple[list[int], bool]:
    """Assumptions that contradict each other, and whether the set is minimal. Starts from a core and removes one
    assumption after the other."""
    with Question(index, assuming=False) as question:
        switches = {question.encoder.fresh(): position for position in range(len(index.assumptions))}
        for switch, position in switches.items():
            question.require(-switch, question.encoder.literal(index.assumptions[position].formula))
        needed = list(switches)
        try:
            question.ask(*needed)
            needed = question.core_among(needed)
            for switch in list(needed):
                without = [kept for kept in needed if kept != switch]
                if len(without) < len(needed) and not question.ask(*without):
                    needed = question.core_among(without)
        except Undecided:
            return [switches[switch] for switch in needed], False
    return [switches[switch] for switch in needed], True


ASSUMPTIONS = Check(
    "assumptions",
    "Do the assumptions allow any situation?",
    (
        FindingKind(
            "SLEEC103",
            "error",
            "assumptions that contradict each other",
            "ASSUME excludes situations that never occur. Together, these assumptions exclude every situation. Then "
            "every check passes, because there is no situation in which anything could go wrong.",
            "Remove the assumption that goes too far, or restrict it with a condition. Use ASSUME for what never "
            "happens, not for what should not happen.",
            "ASSUME Day OR Night\nASSUME NOT Day\nASSUME NOT Night\nWHEN UserCalls THEN Answer\n"
            "UNLESS Day IN WHICH CASE AnswerLoudly\nUNLESS Night IN WHICH CASE AnswerQuietly\n",
            "ASSUME Day OR Night\nASSUME NOT (Day AND Night)\nWHEN UserCalls THEN Answer\n"
            "UNLESS Night IN WHICH CASE AnswerQuietly\n",
        ),
    ),
    _contradictory,
)
