"""Demands: what a response requires of a trace, as a formula over occurrences in windows.

A demand is a formula of metric temporal logic over one instant, in negation normal form (R. Koymans, "Specifying
real-time properties with metric temporal logic", 1990). Its atoms say that an event occurs, or does not occur, in a
window of seconds after that instant.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain as chained
from itertools import product
from math import ceil, floor
from typing import NamedTuple, Union

from sleec_runtime.model import Clause, Length, Obligation, Rational, Window, in_text_order
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.encoding.window_lengths import WindowLengths
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


class Occurs(NamedTuple):
    """The event occurs (`negated`: does not occur) at some time from `start` to `end`, in seconds after the
    trigger, both included. None means unbounded."""

    event: str
    start: int | None
    end: int | None
    negated: bool = False

    @property
    def is_immediate(self) -> bool:
        """Whether its window is the instant of the trigger."""
        return self.start == self.end == 0


@dataclass(frozen=True, slots=True)
class Every:
    parts: tuple[Demand, ...]


@dataclass(frozen=True, slots=True)
class Some:
    parts: tuple[Demand, ...]


Demand = Union[int, Occurs, Every, Some]
"""A formula in negation normal form. An integer is a literal about the instant of the trigger."""

Chain = Callable[[Clause], Sequence[int]]
"""For each clause of a separate chain, in the order of the text, the literal "this clause decides"."""


class Responses:
    """The demands of responses, under one meaning of those without a window."""

    def __init__(self, untimed: Untimed, lengths: WindowLengths | None = None) -> None:
        """Without `lengths`, no window may depend on a measure."""
        self._untimed = untimed
        self._lengths = lengths
        self._fixed: dict[tuple[int, bool, int], tuple[Obligation, Demand]] = {}
        """The demands of obligations without chains, as `_obligation` returns them."""
        self._variants: dict[int, tuple[Obligation, list[tuple[Demand, list[tuple[int, ...]]]]]] = {}

    def of(self, obligations: tuple[Obligation, ...], chain: Chain, kept: bool = True, after: int = 0) -> Demand:
        """The demand that all of `obligations`, which are due after this number of seconds, are met (not `kept`: that
        one is not met).

        Raises `Undecided` if the length of a window has no bounds.
        """
        parts = tuple(self._obligation(o, chain, kept, after) for o in obligations)
        return _joined(parts, every=kept)

    def of_clause(self, clause: Clause, chain: Chain, kept: bool = True, after: int = 0) -> Demand:
        """The same as `of`, for a response with its own chain of hedges."""
        if not clause.hedges:
            return self.of(clause.obligations, chain, kept, after)
        members = []
        for member, decides in zip(in_text_order(clause), chain(clause)):
            if decides == _NEVER:
                continue
            due = self.of(member.obligations, chain, kept, after)
            members.append(Some((-decides, due)) if kept else Every((decides, due)))
        return _joined(tuple(members), every=kept)

    def _obligation(self, obligation: Obligation, chain: Chain, kept: bool, after: int) -> Demand:
        key = id(obligation), kept, after
        known = self._fixed.get(key)
        if known is not None and known[0] is obligation:
            return known[1]
        chains: list[Clause] = []

        def literals(clause: Clause) -> Sequence[int]:
            chains.append(clause)
            return chain(clause)

        demand = self._demand(obligation, literals, kept, after)
        if not chains:
            self._fixed[key] = obligation, demand
        return demand

    def _demand(self, obligation: Obligation, chain: Chain, kept: bool, after: int) -> Demand:
        cases = None if self._lengths is None else self._lengths.cases(obligation)
        if cases is not None:
            return self.of_clause(cases, chain, kept, after)
        timing = obligation.timing
        start, end = self.window(obligation)
        negated = obligation.negated == kept
        itself: Demand = Occurs(obligation.name, after + start, None if end is None else after + end, negated)
        if end is not None and end < start:
            itself = _joined((), every=negated)
        if timing is None:
            return itself
        parts = [itself]
        if timing.otherwise is not None:
            if end is not None and end < 0:
                raise Undecided(
                    sentence(
                        "the length of a window of {event} can be negative; exclude such values",
                        event=quoted(obligation.name),
                    )
                )
            closed = after + end if timing.window is not None and end is not None else after
            parts.append(self.of_clause(timing.otherwise, chain, kept, closed))
        if timing.instead is not None:
            parts.append(self.of_clause(timing.instead, chain, kept, after))
        return _joined(tuple(parts), every=not kept)

    def window(self, obligation: Obligation) -> tuple[int, int | None]:
        """The first and the last second of the window of a response, after its trigger.

        Raises `Undecided` if a measure gives the length.
        """
        window: Window | None = None if obligation.timing is None else obligation.timing.window
        if window is None:
            return (0, 0) if self._untimed == "at" else (0, None)
        # Instants are whole seconds.
        start = 0 if window.start is None else ceil(seconds(window.start))
        return start, None if window.end is None else floor(seconds(window.end))

    def variants(self, obligation: Obligation) -> list[tuple[Demand, list[tuple[int, ...]]]]:
        """The demands of one obligation, without literals, each with the choices that lead to it: which clause of each
        chain inside the response decides."""
        known = self._variants.get(id(obligation))
        if known is None or known[0] is not obligation:
            known = self._variants[id(obligation)] = obligation, self._variants_of(obligation)
        return known[1]

    def _variants_of(self, obligation: Obligation) -> list[tuple[Demand, list[tuple[int, ...]]]]:
        found: dict[Demand, list[tuple[int, ...]]] = {}
        cases = self._of_each_value(obligation)
        for number, one in enumerate(cases or ()):
            for demand, choices in self.variants(one):
                found.setdefault(demand, []).extend((number, *choice) for choice in choices)
        if cases is None:
            for choice in self._choices(obligation):
                values = {_DECIDES: True, -_DECIDES: False}
                demand = simplified(self.of((obligation,), _Chosen(choice, lambda _: ()).flags), values)
                found.setdefault(demand, []).append(choice)
        return list(found.items())

    def _of_each_value(self, obligation: Obligation) -> list[Obligation] | None:
        """The obligation for each value of a measure; None if none gives a length of its windows."""
        cases = None if self._lengths is None else self._lengths.cases(obligation)
        return None if cases is None else [one for member in in_text_order(cases) for one in member.obligations]

    def _choices(self, obligation: Obligation) -> Iterator[tuple[int, ...]]:
        """Which clause of each chain inside a response decides, in the order in which the chains are read. A clause
        that does not decide is not read."""
        alternatives = [] if obligation.timing is None else list(obligation.timing.alternatives())
        for parts in product(*(list(self._choices_of_chain(clause)) for clause in alternatives)):
            yield tuple(chained.from_iterable(parts))

    def _choices_of_chain(self, clause: Clause) -> Iterator[tuple[int, ...]]:
        for number, member in enumerate(in_text_order(clause)):
            for parts in product(*(list(self._choices(obligation)) for obligation in member.obligations)):
                yield (*([number] if clause.hedges else ()), *chained.from_iterable(parts))

    def deciding(self, obligation: Obligation, choice: tuple[int, ...], chain: Chain) -> list[int]:
        """The literals for which the chains inside a response decide as in `choice`."""
        cases = None if self._lengths is None else self._lengths.cases(obligation)
        if cases is not None:
            number, *others = choice
            own = (cases, *cases.hedges)[number].obligations[0]
            return [chain(cases)[number], *self.deciding(own, tuple(others), chain)]
        chosen = _Chosen(choice, chain)
        self.of((obligation,), chosen.flags)
        return chosen.literals


class _Chosen:
    """One choice of deciding clauses, applied to the chains of a response in the order in which they are read."""

    def __init__(self, choice: tuple[int, ...], chain: Chain) -> None:
        self._choice = iter(choice)
        self._chain = chain
        self.literals: list[int] = []

    def flags(self, clause: Clause) -> list[int]:
        number = next(self._choice)
        literals = self._chain(clause)
        if number < len(literals):
            self.literals.append(literals[number])
        return [_DECIDES if place == number else _NEVER for place, _ in enumerate(in_text_order(clause))]


_DECIDES = 1
_NEVER = 0
"""In place of the literal of a clause that does not decide. No literal is 0."""


def simplified(demand: Demand, values: dict[int, bool]) -> Demand:
    """The demand with the literals of `values` replaced by their values. `Every(())` is true and `Some(())` false."""
    if isinstance(demand, Occurs):
        return demand
    if isinstance(demand, int):
        return (Every(()) if values[demand] else Some(())) if demand in values else demand
    parts: list[Demand] = []
    absorbing: Demand = Some(()) if isinstance(demand, Every) else Every(())
    for part in demand.parts:
        simple = simplified(part, values)
        if simple == absorbing and type(simple) is type(absorbing):
            return absorbing
        if type(simple) is type(demand):
            parts += simple.parts
        else:
            parts.append(simple)
    return _joined(tuple(parts), every=isinstance(demand, Every))


def seconds(length: Length) -> Rational:
    """A length of time in seconds. Raises `Undecided` if it depends on measures."""
    value = length.seconds
    if value is None:
        raise Undecided(
            sentence(
                "nothing bounds a measure that gives the duration {duration}; declare a range of the measure",
                duration=quoted(str(length)),
            )
        )
    return value


def last_second(length: Length) -> int:
    """The last second of this length of time, counted from 0. Raises `Undecided` if the length depends on measures."""
    return int(-(-seconds(length) // 1) - 1)


def _joined(parts: tuple[Demand, ...], every: bool) -> Demand:
    """The conjunction or disjunction of some demands. Two overlapping windows for one event become one, if it must
    occur in one of them, or in neither."""
    joined: list[Demand] = []
    for part in parts:
        for place, other in enumerate(joined):
            union = _union(part, other) if isinstance(part, Occurs) and isinstance(other, Occurs) else None
            if union is not None and union.negated == every:
                joined[place] = union
                break
        else:
            joined.append(part)
    if len(joined) == 1:
        return joined[0]
    return Every(tuple(joined)) if every else Some(tuple(joined))


def _union(one: Occurs, other: Occurs) -> Occurs | None:
    """The atom with both windows, if two atoms are about one event and leave no gap."""
    if (one.event, one.negated) != (other.event, other.negated) or one.start is None or other.start is None:
        return None
    first, second = (one, other) if one.start <= other.start else (other, one)
    assert second.start is not None
    if first.end is None or (second.end is not None and second.end <= first.end):
        return first
    return first._replace(end=second.end) if second.start <= first.end + 1 else None


def occurrences(demand: Demand) -> Iterator[Occurs]:
    """Every atom of a demand."""
    if isinstance(demand, Occurs):
        yield demand
    elif not isinstance(demand, int):
        for part in demand.parts:
            yield from occurrences(part)


def conjuncts(demand: Demand) -> Iterator[Occurs]:
    """The atoms that hold if the demand holds, for all values of its literals."""
    if isinstance(demand, Occurs):
        yield demand
    elif isinstance(demand, Every):
        for part in demand.parts:
            yield from conjuncts(part)
