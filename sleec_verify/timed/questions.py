"""The questions about traces that one existential answers: does some trace do this?"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple, TypeVar

from sleec_runtime.model import Rule
from sleec_runtime.model_time import Claim
from sleec_verify.solver import Undecided
from sleec_verify.timed.program import Program
from sleec_verify.timed.timeline import Timeline, timeline
from sleec_verify.timed.unfolding import Unfolding

_Found = TypeVar("_Found")


_FEW = 4
"""Instants that may be added by the way, and clauses with which no more are."""

_FEW_CLAUSES = 2_000


class Answer(NamedTuple):
    """`trace` is one that does it, or None if none does; `matter` are then the rules and laws that prevent it."""

    trace: Timeline | None
    matter: tuple[str, ...] = ()


def decided(program: Program, question: Callable[[], _Found], *without: frozenset[str]) -> _Found:
    """The answer to `question`. Where it cannot be decided, events are looked for that occur in no trace that keeps all
    but the rules `without`, for each such set, and it is asked again: it uses `Program.impossible`."""
    try:
        return question()
    except Undecided:
        news = [program.look_for_impossible(labels) for labels in without]
        if not any(news):
            raise
        return question()


def _ask(
    program: Program,
    what: Callable[[Unfolding, int], Sequence[int]],
    without: frozenset[str] = frozenset(),
    rules: Mapping[str, Sequence[Rule]] | None = None,
) -> Answer:
    """Whether some trace has an instant at which `what` holds: literals about an instant of an unfolding."""

    def begun(impossible: frozenset[str]) -> tuple[Unfolding, list[int]]:
        unfolding = Unfolding(program, without=without, rules=rules, impossible=impossible)
        return unfolding, list(what(unfolding, unfolding.instant(unfolding.formula.true)))

    def question() -> Answer:
        # Of rules that stand in for others, nothing is known.
        impossible = program.impossible(without) if rules is None else frozenset()
        unfolding, required = begun(impossible)
        if unfolding.ask(*required):
            return Answer(timeline(unfolding))
        matter = needed(unfolding, required)
        if impossible and not matter:
            # What is known to be impossible leaves nothing to name, though it may be so by what one instant has to be.
            unfolding, required = begun(frozenset())
            if not unfolding.trusting(*required):
                matter = needed(unfolding, required)
        return Answer(None, tuple(matter))

    return decided(program, question, *([without] if rules is None else []))


def needed(unfolding: Unfolding, required: Sequence[int] = ()) -> list[str]:
    """A minimal set of rules and laws with which the last answer is still no."""
    kept = unfolding.matter()
    for name in list(kept):
        without = [other for other in kept if other != name]
        try:
            if not unfolding.ask(*required, let_in=without):
                kept = without
        except Undecided:
            continue
    return kept


def breaking(program: Program, rule: Rule) -> Answer:
    """A trace that keeps all else and breaks `rule`: without one, the rule is redundant."""
    return _ask(program, lambda u, seed: [u.broken(seed, rule)], frozenset({rule.label}))


def exchanging(program: Program, rule: Rule, other: Rule) -> Answer:
    """A trace that keeps all with `other`, of the same trigger and label, in the place of `rule`, and breaks `rule`."""
    exchanged = [r for r in program.by_trigger[rule.trigger] if r.label != rule.label]
    rules = ChainMap({rule.trigger: [*exchanged, other]}, program.by_trigger)
    return _ask(program, lambda u, seed: [u.broken(seed, rule)], rules=rules)


def triggering(program: Program, rule: Rule) -> Answer:
    """A trace in which `rule` is triggered and its guard holds."""
    return _ask(program, lambda u, seed: [u.instants[seed].event(rule.trigger), u.condition(seed, rule.guard)])


def can_occur(program: Program, event: str, without: frozenset[str] = frozenset()) -> bool:
    """Whether an event occurs in any trace that keeps all but the rules `without`; True where that takes longer than
    what is asked by the way may take."""
    return _by_the_way(program, lambda u, seed: u.instants[seed].event(event), without)


def can_decide(program: Program, rule: Rule, clause: int, without: frozenset[str] = frozenset()) -> bool:
    """As `can_occur`, of a clause of a rule that decides."""
    return _by_the_way(program, lambda u, seed: u.guards(seed, rule)[clause][1], without)


def _by_the_way(program: Program, what: Callable[[Unfolding, int], int], without: frozenset[str]) -> bool:
    unfolding = Unfolding(
        program, without=without, impossible=program.impossible(without), most=_FEW, most_clauses=_FEW_CLAUSES
    )
    try:
        return unfolding.ask(what(unfolding, unfolding.instant(unfolding.formula.true)))
    except Undecided:
        return True


def together_at_once(program: Program, rule: Rule, clause: int, others: Iterable[Rule]) -> set[tuple[str, int]]:
    """The clauses of other rules, by labels and places, that may decide at one instant with a clause of a rule."""
    unfolding = Unfolding(program, rules={})
    seed = unfolding.instant(unfolding.formula.true)
    here = unfolding.guards(seed, rule)[clause][1]
    return {
        (other.label, place)
        for other in others
        for place, (_, guard) in enumerate(unfolding.guards(seed, other))
        if unfolding.ask(here, guard)
    }


def reachable(program: Program, rule: Rule) -> list[bool]:
    """Which clauses of `rule` decide in some trace of the laws alone, whether or not rules are kept."""

    def clause(number: int) -> bool:
        return _ask(program, lambda u, seed: [u.guards(seed, rule)[number][1]], rules={}).trace is not None

    return [clause(number) for number, _ in enumerate(rule.clauses())]


def coming_about(program: Program, claim: Claim) -> Answer:
    """A trace in which a concern or purpose comes about. `meanwhile` may come about anywhere in it."""

    def at(unfolding: Unfolding, instant: int, part: Claim) -> list[int]:
        return [
            unfolding.instants[instant].event(part.event),
            unfolding.condition(instant, part.condition),
            *(
                unfolding.demand(instant, program.responses.of_clause(response, unfolding.chain(instant)))
                for response in part.responses
            ),
        ]

    def what(unfolding: Unfolding, seed: int) -> list[int]:
        required = at(unfolding, seed, claim)
        part = claim.meanwhile
        while part is not None:
            required.append(
                unfolding.exists(lambda other, part=part: unfolding.formula.every(at(unfolding, other, part)))  # type: ignore[misc]
            )
            part = part.meanwhile
        return required

    return _ask(program, what)
