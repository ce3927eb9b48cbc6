"""A trace that keeps some rules, grown as far as they call for it.

The first instant is the one that the question is about. The rules of an event are written down for an instant once the
solver lets it occur there, and an instant is added once a response cannot be met at those that there are. Until then,
that it is met at some other instant is taken on trust, so:

- no model with that trust is no trace, however long;
- a model without any such trust is a trace, with exactly the instants that it has.

Between the two, an instant is added for each response that the model trusts to be met elsewhere. Where responses do
not come back to their own trigger, this ends; where they do, it may not, and is given up after `MOST` instants.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence, Set

from sleec_runtime.model import (
    Clause,
    Obligation,
    Rule,
    Value,
)
from sleec_runtime.model import (
    Formula as Condition,
)
from sleec_verify.budget import Undecided, spend
from sleec_verify.solver import MiniSat
from sleec_verify.timed.instant import Fixed, Formula, Instant
from sleec_verify.timed.laws import law_at
from sleec_verify.timed.needs import Decided, Need, Placed
from sleec_verify.timed.program import Follower, Program
from sleec_verify.timed.responses import Demand, Every, Occurs
from sleec_verify.timed.times import Times
from sleec_verify.timed.unseen import LeftOut, Unseen
from sleec_verify.timed.windows import allows, inside

MOST = 12
"""Instants that may be added before the search for a trace is given up. Published rulesets need three."""

MOST_CLAUSES = 20_000
"""Clauses with which no more instants are added: from there, each takes seconds."""

MOST_COMPARED = 300_000
"""Pairs of instants whose times may be compared in all, model by model: a few seconds."""

_PER_CLAUSE = 4
"""Steps of a budget to make one clause, besides those to give it to the solver."""

MOST_AT_ONCE = 12
"""As many may be added at once, where one may do for several of them."""

PATIENCE = 5
"""How many times as much of all this it may take where it comes to an end by itself."""


_Trust = Callable[[Need], bool]
"""Which needs are taken on trust to be met at instants still to come."""


class Unfolding:
    """One question about the traces of a program."""

    def __init__(
        self,
        program: Program,
        *,
        without: frozenset[str] = frozenset(),
        beginning: Sequence[Fixed] = (),
        rules: Mapping[str, Sequence[Rule]] | None = None,
        most: int = MOST,
        most_clauses: int = MOST_CLAUSES,
        times: Mapping[int, int] | None = None,
        impossible: frozenset[str] = frozenset(),
        in_part: int = 0,
        unseen: Mapping[Unseen, bool] | None = None,
    ) -> None:
        """The rules `without` are not in force. `beginning` are instants that are settled, in the order of time, the
        last of them open to more events; all further ones come after it. `times` are those that are known of further
        instants, by their numbers. `rules` replace those of the program.
        `impossible` are events that are known to occur in no trace. The first `in_part` instants, after which comes
        now, are only part of those before now; what came about at others is `unseen`, if that is known, or open."""
        self.program = program
        self.formula = Formula()
        self.add = self.formula.clauses.append
        known = {number: fixed.time for number, fixed in enumerate(beginning)} | dict(times or {})
        self.times = Times(self.formula.fresh, self.add, self.formula.true, known)
        self.instants: list[Instant] = []
        self._without = without
        self._rules = program.by_trigger if rules is None else rules
        patience = PATIENCE if program.is_acyclic else 1
        self._most = most * patience
        self._most_clauses = most_clauses * patience
        self._grown = 0
        self._refused = 0
        self._compared = 0
        self._most_compared = MOST_COMPARED * patience
        self._there_for: dict[int, int] = {}
        self._impossible = impossible
        self.left_out = LeftOut(self.formula, self.times, in_part, unseen)
        self._needs: list[Need] = []
        self._nevers: dict[str, list[Placed]] = {}
        self._firsts: list[Need] = []
        self._everywhere: list[Callable[[int], None]] = []
        self._in_force: dict[str, int] = {}
        self.now = len(beginning) - 1
        self.spared: set[tuple[str, int]] = set()
        """Rules that do not speak of some instant: ``(label, instant)``."""
        self.decided: list[Decided] = []
        self._solver = MiniSat()
        self._sent = 0
        self._core: set[int] = set()
        for law in program.laws:
            self._everywhere.append(law_at(self, law))
        for fixed in beginning:
            self.instant(self.formula.true, fixed)

    # The trace ------------------------------------------------------------------------------------------------

    def instant(self, used: int | None = None, fixed: Fixed | None = None) -> int:
        """Add an instant, which is one of the trace if `used`; returns its number."""
        number = len(self.instants)
        if used is None:
            used = self.formula.fresh()
        here = Instant(self.formula, self.program.ruleset.measures, used, fixed, self._impossible)
        self.instants.append(here)
        for other in range(number):
            # One time is one instant.
            self.add(
                [
                    -used,
                    -self.instants[other].used,
                    -self.times.at_most(other, number, 0),
                    self.times.at_most(other, number, -1),
                ]
            )
        if fixed is None and 0 <= self.now < number:
            self.add([-used, self.times.before(self.now, number)])
        # What these add, they add for this instant too.
        waiting = list(self._needs)
        for make in list(self._everywhere):
            make(number)
        for need in waiting:
            self._offer(need, number)
        for first in self._firsts:
            for part in first.parts:
                self._offer(part, number)
                self._close(first, part)
        return number

    def exists(self, witness: Callable[[int], int]) -> int:
        """A literal that implies that `witness` (an instant to a literal that implies that it is used) holds at some
        instant."""
        literal = self.formula.fresh()
        self._look_for(Need(witness, literal))
        return literal

    def _look_for(self, need: Need) -> None:
        self._needs.append(need)
        for number in range(len(self.instants)):
            self._offer(need, number)
        if need.placed is not None and need.placed.at <= self.now < len(self.instants):
            at, what, _ = need.placed
            if what.end is not None:
                # Those still to come are after now.
                self.add([-need.rest, self.times.at_most(at, self.now, what.end - 1)])

    def first(self, witness: Callable[[int], int]) -> Need:
        """The first instant at which `witness` holds, if there is any, as one thing to look for."""
        need = Need(witness, self.formula.fresh())
        self._firsts.append(need)
        self._look_for(need)
        return need

    def by_first(self, first: Need, witness: Callable[[int], int], to_come: bool = True) -> int:
        """As `exists`, where `witness` demands more than that of `first`, and the first instant of that is as
        good as any. Unless it may be one that is `to_come`, it is one of those that there are."""
        literal = self.formula.fresh()
        part = Need(witness, literal)
        for number in range(len(self.instants)):
            self._offer(part, number)
        if to_come:
            first.parts.append(part)
            self._close(first, part)
        else:
            self.add([-part.rest])
        return literal

    def _close(self, first: Need, part: Need) -> None:
        """What is still to come for a part is the first instant, until that has come."""
        self.add([-part.rest, first.rest] if first in self._needs else [-part.rest])

    def _offer(self, need: Need, number: int) -> None:
        here = need.witness(number)
        if here == -self.formula.true:
            return
        rest = self.formula.fresh()
        self.add([-need.rest, here, rest])
        need.rest = rest

    def everywhere(self, make: Callable[[int], None]) -> None:
        """Call `make` for every instant, those still to come included."""
        self._everywhere.append(make)
        for number in range(len(self.instants)):
            make(number)

    def occurs(self, at: int, what: Occurs) -> int:
        """A literal that implies an occurrence, or that there is none, in a window around instant `at`."""
        if what.start == what.end == 0:
            event = self.instants[at].event(what.event)
            return -event if what.negated else event
        unseen = self.left_out.came_about(at, what.event, what.start, what.end)
        if not what.negated:
            later = what.event if what.start is not None and what.start >= 0 else None
            literal = self.formula.fresh()
            witness = lambda other: self.occurrence(at, other, what)  # noqa: E731
            self._look_for(Need(witness, literal, later, Placed(at, what, literal)))
            return literal if unseen == -self.formula.true else self.formula.any_of([literal, unseen])
        never = self.formula.fresh()
        self._nevers.setdefault(what.event, []).append(Placed(at, what, never))
        self.add([-never, -unseen])

        def not_there(other: int) -> None:
            bounds = self.times.bounds(at, other, what.start, what.end)
            if -self.formula.true not in bounds:
                self.add([-never, -self.instants[other].event(what.event), *(-bound for bound in bounds)])

        self.everywhere(not_there)
        return never

    def occurrence(self, at: int, other: int, what: Occurs) -> int:
        """A literal that implies that the event occurs at instant `other`, in a window around instant `at`."""
        bounds = self.times.bounds(at, other, what.start, what.end)
        if -self.formula.true in bounds:
            return -self.formula.true
        return self.formula.every([self.instants[other].event(what.event), *bounds])

    def demand(self, at: int, demand: Demand) -> int:
        """A literal that implies a demand of instant `at`."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            return self.occurs(at, demand)
        parts = [self.demand(at, part) for part in demand.parts]
        if isinstance(demand, Every):
            return self.formula.every(parts) if parts else self.formula.true
        return self.formula.any_of(parts) if parts else -self.formula.true

    # What must be kept ----------------------------------------------------------------------------------------

    def chain(self, at: int) -> Callable[[Clause], list[int]]:
        """What decides a chain of hedges that stands by itself, by the measures of instant `at`."""
        return lambda clause: self.instants[at].chain(clause, self.program.ruleset.reading)

    def guards(self, at: int, rule: Rule) -> list[tuple[Clause, int]]:
        """The clauses of a rule with the literals of their guards at instant `at`."""
        return list(zip(rule.clauses(), self.instants[at].guards(rule, self.program.ruleset.reading)))

    def due(self, at: int, obligations: tuple[Obligation, ...], kept: bool = True) -> Demand:
        return self.program.responses.of(obligations, self.chain(at), kept)

    def broken(self, at: int, rule: Rule) -> int:
        """A literal that implies that instant `at` triggers the rule, which is not kept."""
        ways = [
            self.formula.every([guard, self.demand(at, self.due(at, clause.obligations, kept=False))])
            for clause, guard in self.guards(at, rule)
            if clause.obligations
        ]
        return self.formula.any_of(ways) if ways else -self.formula.true

    def in_force(self, label: str) -> int:
        """The literal "this rule counts", by which cores name the rules that matter."""
        literal = self._in_force.get(label)
        if literal is None:
            literal = self._in_force[label] = self.formula.fresh()
        return literal

    def _rule_at(self, at: int, rule: Rule) -> None:
        in_force = self.in_force(rule.label)
        for number, (clause, guard) in enumerate(self.guards(at, rule)):
            if clause.obligations:
                due = self.due(at, clause.obligations)
                self.decided.append(Decided(at, rule, number, clause, guard, due))
                self.add([-in_force, -guard, self.demand(at, due)])

    def deciding(self, at: int, rule: Rule) -> list[Decided]:
        """The clauses of a rule with the literals that they decide at an instant, if it triggers the rule."""
        guards = self.instants[at].guards(rule, self.program.ruleset.reading, self.formula.true)
        return [
            Decided(at, rule, number, clause, guard, self.due(at, clause.obligations))
            for number, (clause, guard) in enumerate(zip(rule.clauses(), guards))
        ]

    def condition(self, at: int, condition: Condition | None) -> int:
        return self.formula.true if condition is None else self.instants[at].literal(condition)

    # Questions ------------------------------------------------------------------------------------------------

    def ask(self, *required: int, let_in: Sequence[str] | None = None) -> bool:
        """Whether there is a trace in which all these literals are true. `let_in` are the labels of the rules and the
        numbers of the laws that count: all, unless given.

        Raises Undecided where the solver gives up, or more instants would be needed than are tried.
        """
        while True:
            if self._solve(required, let_in, lambda need: False):
                return True
            if not any(-need.rest in self._core for need in self._needs):
                return False
            if not self._solve(required, let_in, lambda need: True):
                return False
            self.grow()

    def grow(self, by: Set[int] | None = None) -> None:
        """Add an instant for each thing that the model found last trusts to come about at some other instant; only for
        what the instants `by` call for, and what that calls for in turn, if that is anything. If these are many, one
        for each event that is called for, but for what has a time of its own: one occurrence may well do for all who
        call for it."""
        trusted = [need for need in self._needs if self.true(need.rest)]
        if not trusted:
            raise self._given_up()
        if by is not None:
            trusted = [n for n in trusted if n.placed is not None and self._root(n.placed.at) in by] or trusted
        if len(trusted) > MOST_AT_ONCE:
            events = {need.later: need for need in reversed(trusted) if need.later is not None}
            trusted = [n for n in trusted if n.later is None or events[n.later] is n or n.wait is not None]
        for need in trusted:
            self._grow(need)

    def _root(self, at: int) -> int:
        """The instant that an instant is there for in the end."""
        while at in self._there_for:
            at = self._there_for[at]
        return at

    @property
    def size(self) -> int:
        """How many clauses it has, but for those that tell what measures and times cannot be."""
        return len(self.formula.clauses) - self._refused

    def _grow(self, need: Need) -> None:
        if self._grown >= self._most or self.size > self._most_clauses:
            raise self._given_up()
        self._grown += 1
        self._needs.remove(need)
        number = len(self.instants)
        if need.placed is not None:
            if need.wait is not None and not self.times.fix(number, need.placed.at, need.wait):
                # One time is one instant, and there is one at this time.
                self.add([-need.rest])
                return
            self._there_for[number] = need.placed.at
        self.instant()
        # What the new instant stands for is met there, or was met at one of the others.
        self.add([-need.rest, need.witness(number)])

    def _given_up(self) -> Undecided:
        several = len(self.instants) != 1
        return Undecided(f"no answer with up to {len(self.instants)} instant{'s' * several}")

    def _assumed(self, required: Sequence[int], let_in: Sequence[str] | None, trusts: _Trust) -> list[int]:
        counting = self._in_force if let_in is None else [name for name in let_in if name in self._in_force]
        distrusted = (-need.rest for need in self._needs if not trusts(need))
        return [*required, *(self._in_force[name] for name in counting), *distrusted]

    def _solve(self, required: Sequence[int], let_in: Sequence[str] | None, trusts: _Trust) -> bool:
        """Solve with all rules written down that the model triggers, and with times that can be."""
        while True:
            self._send()
            assumed = self._assumed(required, let_in, trusts)
            answer = self._solver.solve(assumed)
            if answer is None:
                raise Undecided("the solver gave up after its budget of conflicts")
            recorder = self.program.recorder
            if not answer:
                core = self._solver.core()
                self._core = set(core)
                if recorder is not None:
                    recorder.refuted(self.formula.clauses, core)
                return False
            if not self._expand() and not self._refine() and not self._rule_out():
                if recorder is not None:
                    recorder.satisfied(self.formula.clauses, assumed, self._solver.holds)
                return True

    def trusting(self, *required: int, but: Set[str] = frozenset()) -> bool:
        """Whether the instants that there are can be part of a trace for all that can be told without adding any, if
        the events of `but` do not occur later."""
        return self._solve(required, None, lambda need: need.later not in but)

    def matter(self) -> list[str]:
        """The rules and laws that the last answer, which was no, rests on."""
        return [name for name, literal in self._in_force.items() if literal in self._core]

    def _send(self) -> None:
        for instant in self.instants:
            instant.settle()
        clauses = self.formula.clauses
        spend(_PER_CLAUSE * (len(clauses) - self._sent))
        self._solver.add(clauses[self._sent :])
        self._sent = len(clauses)

    def _expand(self) -> bool:
        """Write down the rules of the events that occur in the model; whether there are any that were not."""
        found = False
        for number, instant in enumerate(self.instants):
            for name, literal in list(instant.events().items()):
                if name not in instant.expanded and self.true(literal):
                    instant.expanded.add(name)
                    for rule in self._rules.get(name, ()):
                        if rule.label not in self._without and (rule.label, number) not in self.spared:
                            found = True
                            self._rule_at(number, rule)
        return found

    def _refine(self) -> bool:
        """Rule out what a model says of measures and times and cannot be; False if all of it can."""
        refused = []
        for instant in self.instants:
            if self.true(instant.used):
                lemma = instant.measures.refused(self.true, self.program.recorder is not None)
                if lemma is not None:
                    refused.append(lemma)
        refused += self.times.refused(self.true, self.used())
        self._compared += self.times.pairs
        if self._compared > self._most_compared:
            raise self._given_up()
        for lemma in refused:
            self.add(lemma)
        self._refused += len(refused)
        return bool(refused)

    def _rule_out(self) -> bool:
        """Tell the solver that nothing of what it takes on trust comes about when it must not; whether that is news."""
        trusted = [
            need.placed
            for need in self._needs
            if need.placed is not None and self.true(need.rest) and self.true(need.placed.literal)
        ]
        trusted += [placed for placed in self.left_out.placed() if self.true(placed.literal)]
        # Rules that the question leaves out, or that the solver is free to.
        not_in_force = {*self._without, *(label for label, _ in self.spared)}
        not_in_force.update(label for label, literal in self._in_force.items() if not self.true(literal))
        times: Mapping[int, int] | None = None
        size = len(self.formula.clauses)
        for call in trusted:
            for what, labels in self._comes_of(call.what):
                if not not_in_force.isdisjoint(labels):
                    continue
                for never in self._nevers.get(what.event, ()):
                    bounds = inside(what, never.what)
                    if bounds is None or not self.true(never.literal):
                        continue
                    if times is None:
                        times, _ = self.schedule()
                    if times.keys() >= {call.at, never.at} and allows(bounds, times[call.at] - times[never.at]):
                        there = self.times.bounds(never.at, call.at, *bounds)
                        because = [call.literal, never.literal, *map(self.in_force, labels), *there]
                        self.add([-literal for literal in because])
        return len(self.formula.clauses) > size

    def _comes_of(self, what: Occurs) -> Iterator[Follower]:
        """What is called for, and all that is bound to follow it where the rules are in force."""
        yield Follower(what, ())
        if self._rules is self.program.by_trigger:
            for follower in self.program.bound_to_follow(what.event):
                yield follower._replace(what=follower.what.following(what))

    def used(self) -> list[int]:
        """The instants that the trace of the last `ask` has."""
        return [number for number, instant in enumerate(self.instants) if self.true(instant.used)]

    def true(self, literal: int) -> bool:
        """Whether a literal is true in the trace of the last `ask`."""
        return self._solver.holds(literal)

    def values(self, at: int) -> dict[str, Value]:
        """The conditions and measures that anything speaks of at an instant of the trace of the last `ask`."""
        instant = self.instants[at]
        found: dict[str, Value] = {
            key[1]: self.true(variable) for key, variable in instant.variables.items() if key[0] == "condition"
        }
        decoded = instant.measures.decode(self.true)
        assert not isinstance(decoded, list), "ask accepts a model only once its order has room"
        found.update(decoded)
        return found

    def happening(self, at: int) -> frozenset[str]:
        """The events of an instant of the trace of the last `ask`."""
        return frozenset(name for name, literal in self.instants[at].events().items() if self.true(literal))

    def schedule(self) -> tuple[dict[int, int], dict[int, tuple[int, int]]]:
        """The earliest times of the trace of the last `ask`, and what each instant waits for."""
        return self.times.schedule(self.true, self.used())
