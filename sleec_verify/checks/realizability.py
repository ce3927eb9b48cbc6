"""Whether the robot can always follow the rules, whatever the environment does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding, Witness
from sleec_verify.traces.index import trace_index_of
from sleec_verify.wording.phrases import first_of, listed, quoted
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_verify.games.realizability import Loss


def realizability(steps: int) -> Check:
    """The check for an environment that acts at most `steps` times."""
    return replace(REALIZABILITY, run=lambda index: _losses(index, steps))


def _losses(index: RulesetIndex, steps: int) -> Iterator[Finding]:
    """A finding for each independent part of the rules that cannot always be followed."""
    from sleec_verify.encoding.solver import Undecided
    from sleec_verify.games.realizability import lost_games

    unknown: dict[str, None] = {}
    for part, question in lost_games(trace_index_of(index), steps):
        try:
            loss = question()
        except Undecided as error:
            named = first_of([quoted(rule.label) for rule in part])
            unknown[sentence("{rules}: {why}", rules=named, why=error.message)] = None
            continue
        if loss is not None:
            yield _finding(loss)
    if unknown:
        raise Undecided(joined("; ", unknown))


def _finding(loss: Loss) -> Finding:
    act = loss.strategy.act
    labels = [rule.label for rule in loss.rules]
    places = [rule.heading_span for rule in loss.rules]
    what = (
        plural(len(labels), "rule {rules}", "rules {rules}", rules=listed(map(quoted, labels)))
        if labels
        else sentence("the relations")
    )
    return REALIZABILITY.finding(
        plural(
            loss.steps,
            "{rules} cannot always be followed: one act of the environment can make it impossible",
            "{rules} cannot always be followed: {number} acts of the environment can make it impossible",
            rules=what,
        ),
        places[0] if places else loss.place,
        rules=tuple(labels),
        witness=Witness(act.events, act.conditions),
        strategy=loss.strategy,
        help=sentence("choose which rule wins, and add an UNLESS to the other; or give the robot more time"),
        related=tuple((place, sentence("together with this rule")) for place in places[1:]),
    )


_EVENTS = "def_start\n  event SmokeDetected\n  event NightBegins\n  event SoundAlarm\n  event Vacuum\ndef_end\n"

REALIZABILITY = Check(
    "realizability",
    "Can the robot always follow the rules, for up to N acts of the environment?",
    (
        FindingKind(
            "SLEEC106",
            "error",
            "rules that the robot cannot always follow",
            "After each act of the environment, the robot can act immediately and plan further acts. Here the "
            "environment has a strategy: whatever the robot does and plans, in the end it cannot follow every rule. "
            "The finding shows the strategy act by act. This check runs only on request, for up to N acts of the "
            "environment: `check --realizable N`.",
            "Choose which rule wins if both apply, and add an UNLESS to the other. Often it is enough to give the "
            "robot more time, or to shorten a prohibition. If the environment never acts like this, exclude it with a "
            "RELATION.",
            _EVENTS + "rule_start\n  R1 when SmokeDetected then SoundAlarm within 2 minutes\n"
            "  R2 when NightBegins then not SoundAlarm within 8 hours\nrule_end\n",
            _EVENTS + "rule_start\n  R1 when SmokeDetected then SoundAlarm within 2 minutes\n"
            "  R2 when NightBegins then not Vacuum within 8 hours\nrule_end\n",
        ),
    ),
    lambda index: _losses(index, 1),
)
