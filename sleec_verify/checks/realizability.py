"""Whether the robot can always keep the rules, whatever the environment does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from sleec_verify.checks.base import Check, FindingKind, listed
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding, Witness
from sleec_verify.traces.index import trace_index_of

if TYPE_CHECKING:
    from sleec_verify.games.realizability import Loss


def realizability(steps: int) -> Check:
    """The check for an environment that acts up to so many times."""
    return replace(REALIZABILITY, run=lambda index: _losses(index, steps))


def _losses(index: RulesetIndex, steps: int) -> Iterator[Finding]:
    """A finding for each part of the rules that has nothing to do with the others and cannot always be kept."""
    from sleec_verify.encoding.solver import Undecided
    from sleec_verify.games.realizability import losses

    unknown: dict[str, None] = {}
    for part, question in losses(trace_index_of(index), steps):
        try:
            loss = question()
        except Undecided as error:
            named = [rule.label for rule in part]
            unknown[f"{', '.join(named[:5])}{f' and {len(named) - 5:,} more' if named[5:] else ''}: {error}"] = None
            continue
        if loss is not None:
            yield _finding(loss)
    if unknown:
        raise Undecided("; ".join(unknown))


def _finding(loss: Loss) -> Finding:
    act = loss.strategy.act
    labels = [rule.label for rule in loss.rules]
    acts = "one act" if loss.steps == 1 else f"{loss.steps} acts"
    places = [rule.label_span if rule.labelled else rule.span for rule in loss.rules]
    what = f"{listed(labels)} cannot always be kept" if labels else "what the relations ask cannot always be kept"
    return REALIZABILITY.finding(
        f"{what}: {acts} of the environment {'leaves' if loss.steps == 1 else 'leave'} the robot no way",
        places[0] if places else loss.place,
        rules=tuple(labels),
        witness=Witness(act.events, act.conditions),
        strategy=loss.strategy,
        help="decide which should give way, and say so with a hedge; or leave the robot more time",
        related=tuple((place, "with this one") for place in places[1:]),
    )


_EVENTS = "def_start\n  event SmokeDetected\n  event NightBegins\n  event SoundAlarm\n  event Vacuum\ndef_end\n"

REALIZABILITY = Check(
    "realizability",
    "Can the robot always keep the rules, whatever the environment does?",
    (
        FindingKind(
            "SLEEC106",
            "error",
            "rules that the robot cannot always keep",
            "With every act of the environment the robot may do something at once and plan more for later. Here the "
            "environment has a strategy: whatever the robot does and plans, in the end no way is left to keep all. The "
            "strategy is shown, act by act. This check is made if it is asked for: `check --realizable N`, for an "
            "environment that acts up to N times.",
            "Decide what should give way when both are called for, and say so with a hedge. Often it is enough to "
            "leave the robot more time, or to forbid for a shorter one. Where the environment never acts like that, "
            "say so with a relation.",
            _EVENTS + "rule_start\n  R1 when SmokeDetected then SoundAlarm within 2 minutes\n"
            "  R2 when NightBegins then not SoundAlarm within 8 hours\nrule_end\n",
            _EVENTS + "rule_start\n  R1 when SmokeDetected then SoundAlarm within 2 minutes\n"
            "  R2 when NightBegins then not Vacuum within 8 hours\nrule_end\n",
        ),
    ),
    lambda index: _losses(index, 1),
)
