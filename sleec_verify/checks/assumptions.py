"""Assumptions that leave no situation at all."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_verify.checks.base import Check, FindingKind, listed
from sleec_verify.cone import Cones
from sleec_verify.finding import Finding
from sleec_verify.question import Question


def _contradictory(cones: Cones) -> Iterator[Finding]:
    """Unsatisfiable exactly when no situation is possible: the assumptions. A model is a possible situation."""
    if not cones.assumptions or cones.possible:
        return
    needed = list(range(len(cones.assumptions)))
    for position in list(needed):
        without = [kept for kept in needed if kept != position]
        if not _possible(cones, without):
            needed = without
    spans = [cones.assumptions[position].span for position in needed]
    place = cones.ruleset.source.place
    lines = [str(place(span).line) for span in spans]
    yield ASSUMPTIONS.finding(
        "the assumption can never be true"
        if len(spans) == 1
        else f"the assumptions of lines {listed(lines)} contradict one another",
        spans[0],
        note="no situation is left, so every rule is dead and nothing else that is said of this ruleset means anything",
        related=tuple((span, "this one too") for span in spans[1:]),
    )


def _possible(cones: Cones, positions: list[int]) -> bool:
    with Question(cones, assuming=False) as question:
        for position in positions:
            question.require_formula(cones.assumptions[position].formula)
        return question.ask()


ASSUMPTIONS = Check(
    "assumptions",
    "Do the assumptions leave any situation possible?",
    (
        FindingKind(
            "SLEEC103",
            "error",
            "assumptions that contradict one another",
            "ASSUME removes situations that cannot be. Together these remove every situation, and then whatever one "
            "asks of the rules holds for want of a counterexample.",
            "Take out the assumption that goes too far, or say in it when it holds. An ASSUME is for what cannot be, "
            "not for what should not be.",
            "ASSUME Day OR Night\nASSUME NOT Day\nASSUME NOT Night\nWHEN UserCalls THEN Answer\n"
            "UNLESS Day IN WHICH CASE AnswerLoudly\nUNLESS Night IN WHICH CASE AnswerQuietly\n",
            "ASSUME Day OR Night\nASSUME NOT (Day AND Night)\nWHEN UserCalls THEN Answer\n"
            "UNLESS Night IN WHICH CASE AnswerQuietly\n",
        ),
    ),
    _contradictory,
)
