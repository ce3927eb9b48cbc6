"""The questions about rules with times by z3: some instants with symbolic times, and what the rules say written down
for each. It borrows the values of the product and nothing else. Bounded, slow, and written to be obviously right.

A trace that it finds is one, whatever the bound. That it finds none means: none of so few instants.

`redundant`, `vacuous`, `concern` and `purpose` look for one trace. `conflict` asks for a history that no trace
continues: one solver proposes histories, another looks for a continuation, and what it finds is kept in the first as a
continuation that the next history must not have (counterexample-guided refinement of ∃∀).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import z3

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Calculated,
    Clause,
    Comparison,
    Exclusive,
    Formula,
    MeasureRef,
    Never,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
)
from sleec_runtime.model_time import (
    RELATIONS,
    SECONDS,
    Claim,
    Effect,
    EventRelation,
    Lasting,
    Length,
    MeasureRelation,
)

TRUE, FALSE = z3.BoolVal(True), z3.BoolVal(False)


def every(parts: Iterable[Any]) -> Any:
    """As z3.And, which looks at the sort of each part first: that took most of the time of the tests."""
    return _joined(z3.Z3_mk_and, parts)


def some(parts: Iterable[Any]) -> Any:
    """As z3.Or, likewise."""
    return _joined(z3.Z3_mk_or, parts)


def _joined(make: Callable[..., Any], parts: Iterable[Any]) -> Any:
    found = [part.ast for part in parts]
    return z3.BoolRef(make(z3.main_ctx().ref(), len(found), (z3.Ast * len(found))(*found)))


class Moment(NamedTuple):
    """An instant of a model: as plain values."""

    time: int
    events: frozenset[str]
    conditions: dict[str, Any]


class Answer(NamedTuple):
    """`found` as in the table of checks. `moments` is the trace that shows what is answered, if there is one:

    one that breaks the rule and nothing else (not redundant), one in which it is triggered (not vacuous), one with the
    concern (found), one with the purpose (not found), the history (conflict found; its last moment is now).
    `continued` is what the history of a conflict could be continued to but for the rule.
    """

    found: bool
    moments: tuple[Moment, ...] | None = None
    continued: tuple[Moment, ...] | None = None


class Undecided(Exception):
    """z3 gave up, or the refinement took too many rounds."""


# Instants -------------------------------------------------------------------------------------------------


class Instant:
    """A symbolic instant: its variables have its name in theirs, so that those nobody asks for do not exist."""

    def __init__(self, ruleset: Ruleset, name: str) -> None:
        self.ruleset, self.name = ruleset, name
        self.time = z3.Int(f"{name}.time")
        self.used = z3.Bool(f"{name}.used")
        self._events: dict[str, Any] = {}

    def event(self, name: str) -> Any:
        found = self._events.get(name)
        if found is None:
            found = self._events[name] = z3.Bool(f"{self.name}.event.{name}")
        return found

    def condition(self, name: str) -> Any:
        return z3.Bool(f"{self.name}.condition.{name}")

    def measure(self, name: str) -> Any:
        """A number, or a place in a scale."""
        sort = z3.Real if self.ruleset.measures[name].kind == "number" else z3.Int
        return sort(f"{self.name}.measure.{name}")

    def possible(self) -> Any:
        """That its time and its scales have values."""
        scales = [m for m in self.ruleset.measures.values() if m.kind == "scale"]
        inside = [z3.And(self.measure(m.name) >= 0, self.measure(m.name) < len(m.values)) for m in scales]
        return z3.And(self.time >= 0, *inside)


class Extended(Instant):
    """An instant with more events, and else as another."""

    def __init__(self, base: Instant, name: str) -> None:
        super().__init__(base.ruleset, name)
        self.base, self.time, self.used = base, base.time, base.used

    def event(self, name: str) -> Any:
        return some((self.base.event(name), super().event(name)))

    def condition(self, name: str) -> Any:
        return self.base.condition(name)

    def measure(self, name: str) -> Any:
        return self.base.measure(name)


class Known(Instant):
    """An instant whose values are known, but for `time`; of a model, to be tried elsewhere."""

    def __init__(self, instant: Instant, model: Any, time: Any) -> None:
        super().__init__(instant.ruleset, instant.name)
        self.instant, self.model, self.time = instant, model, time
        self.used = model.eval(instant.used, model_completion=True)

    def event(self, name: str) -> Any:
        return TRUE if z3.is_true(self.model.eval(self.instant.event(name), model_completion=True)) else FALSE

    def condition(self, name: str) -> Any:
        return self.model.eval(self.instant.condition(name), model_completion=True)

    def measure(self, name: str) -> Any:
        return self.model.eval(self.instant.measure(name), model_completion=True)


class More(Extended):
    """An instant with the further events of a model."""

    def __init__(self, base: Instant, extended: Extended, model: Any) -> None:
        super().__init__(base, extended.name)
        self.model = model

    def event(self, name: str) -> Any:
        return z3.Or(self.base.event(name), self.model.eval(z3.Bool(f"{self.name}.event.{name}"), True))


Instants = Sequence[Instant]


def ordered(instants: Instants, first_used: bool) -> Any:
    """Times that increase; the instants that are not used are the last ones, or the first."""
    parts = [instant.possible() for instant in instants]
    for earlier, later in pairwise(instants):
        parts.append(z3.Implies(z3.And(earlier.used, later.used), earlier.time < later.time))
        parts.append(z3.Implies(later.used, earlier.used) if first_used else z3.Implies(earlier.used, later.used))
    return z3.And(parts)


# What the rules say ---------------------------------------------------------------------------------------


class Meaning:
    """What a ruleset says of some instants."""

    def __init__(self, ruleset: Ruleset, instants: Instants, untimed: str) -> None:
        self.ruleset, self.instants, self.untimed = ruleset, instants, untimed

    def all_rules(self, but: Callable[[Any, int], bool] = lambda law, index: False) -> Any:
        """Γ, without the statements at instants that `but` picks."""
        return z3.And(
            [
                self.law(law, index)
                for law in laws(self.ruleset)
                for index in range(len(self.instants))
                if not but(law, index)
            ]
        )

    def law(self, law: Any, index: int) -> Any:
        """A rule, relation or constraint, as far as it speaks of one instant."""
        instant = self.instants[index]
        if isinstance(law, Rule):
            return z3.Implies(self.triggered(law, instant), self.rule(law, instant))
        return z3.Implies(instant.used, self.relation(law, index))

    def triggered(self, rule: Rule, instant: Instant) -> Any:
        guard = TRUE if rule.guard is None else formula(rule.guard, instant)
        return every((instant.used, instant.event(rule.trigger), guard))

    def rule(self, rule: Rule, instant: Instant) -> Any:
        return self.chain(self.clause(rule.default, instant, instant.time), rule.hedges, instant, instant.time)

    def clause(self, clause: Clause, instant: Instant, due: Any) -> Any:
        """A clause that decides its own chain; what is nested in it may take over."""
        own = every([self.obligation(o, instant, due) for o in clause.obligations])
        return self.chain(own, clause.hedges, instant, due)

    def chain(self, default: Any, hedges: Sequence[Clause], instant: Instant, due: Any) -> Any:
        if self.ruleset.reading == "priority":
            for hedge in hedges:
                default = z3.If(formula(hedge.condition, instant), self.clause(hedge, instant, due), default)
            return default
        if not hedges:
            return default
        rest = self.chain(self.clause(hedges[0], instant, due), hedges[1:], instant, due)
        return z3.If(formula(hedges[0].condition, instant), rest, default)

    def obligation(self, obligation: Obligation, instant: Instant, due: Any) -> Any:
        """Kept, or one of the responses in place of it is. `instant` is that of the trigger, `due` the time from which
        its window counts."""
        timing = obligation.timing
        over = due
        if timing is None or timing.window is None:
            within = [every((i.time >= due, i.time <= due if self.untimed == "at" else TRUE)) for i in self.instants]
        else:
            first = due if timing.window.start is None else due + seconds(timing.window.start, instant)
            within = [i.time >= first for i in self.instants]
            if timing.window.end is not None:
                over = due + seconds(timing.window.end, instant)
                within = [every((w, i.time <= over)) for w, i in zip(within, self.instants)]
        here = [i.event(obligation.name) for i in self.instants]
        occurs = some([every((i.used, w, e)) for i, w, e in zip(self.instants, within, here) if e is not FALSE])
        ways = [z3.Not(occurs) if obligation.negated else occurs]
        if timing is not None and timing.otherwise is not None:
            ways.append(self.clause(timing.otherwise, instant, over))
        if timing is not None and timing.instead is not None:
            ways.append(self.clause(timing.instead, instant, due))
        return some(ways)

    def claim(self, claim: Claim) -> Any:
        here = [
            z3.And(
                i.used,
                i.event(claim.event),
                TRUE if claim.condition is None else formula(claim.condition, i),
                *(self.clause(response, i, i.time) for response in claim.responses),
            )
            for i in self.instants
        ]
        return z3.And(z3.Or(here), TRUE if claim.meanwhile is None else self.claim(claim.meanwhile))

    def relation(self, law: Any, index: int) -> Any:
        i = self.instants[index]
        if isinstance(law, Exclusive):
            return z3.AtMost(*[i.event(name) for name in law.names], 1)
        if isinstance(law, Never):
            return z3.Not(formula(law.formula, i))
        if isinstance(law, Assume):
            return formula(law.formula, i)
        if isinstance(law, EventRelation):
            a, b = i.event(law.left), i.event(law.right)
            before = z3.Or([z3.And(j.used, j.event(law.left)) for j in self.instants[:index]])
            return {
                "witness": z3.Implies(a, b),
                "equal": a == b,
                "mutualExclusive": z3.Not(z3.And(a, b)),
                "happenBefore": z3.Implies(b, before),
            }[law.relation]
        if isinstance(law, MeasureRelation):
            p = formula(law.left, i)
            q = TRUE if law.right is None else formula(law.right, i)
            return {
                "imply": z3.Implies(p, q),
                "iff": p == q,
                "mutualExclusive": z3.Not(z3.And(p, q)),
                "opposite": z3.Not(z3.And(p, q)),
                "invariant": p,
            }[law.relation]
        if isinstance(law, Effect):
            e, p = i.event(law.event), formula(law.formula, i)
            return {
                "causation": z3.Implies(p, e),
                "includes": z3.Implies(e, p),
                "forbid": z3.Implies(e, z3.Not(p)),
            }[law.relation]
        assert isinstance(law, Lasting)
        begins = z3.And(i.event(law.event), TRUE if law.condition is None else formula(law.condition, i))
        holds = []
        ended: Any = FALSE
        for j in self.instants[index:]:
            if law.duration is not None:
                ended = j.time >= i.time + seconds(law.duration, i)
            else:
                assert law.end is not None
                end = TRUE if law.end_condition is None else formula(law.end_condition, j)
                ended = z3.Or(ended, z3.And(j.used, j.event(law.end), end))
            holds.append(z3.Or(z3.Not(j.used), ended, formula(law.formula, j)))
        return z3.Implies(begins, z3.And(holds))


def laws(ruleset: Ruleset) -> list[Any]:
    return [s for s in ruleset.statements if isinstance(s, (Rule, Exclusive, Never, Assume, *RELATIONS))]


def seconds(length: Length, instant: Instant) -> Any:
    return side(length.amount, instant) * SECONDS[length.unit]


def number(value: Any) -> Any:
    return z3.IntVal(value) if isinstance(value, int) else z3.RealVal(str(value))


def formula(f: Formula | None, instant: Instant) -> Any:
    if isinstance(f, Truth):
        return z3.BoolVal(f.value)
    if isinstance(f, Atom):
        return instant.condition(f.name) if f.kind == "condition" else instant.event(f.name)
    if isinstance(f, Not):
        return z3.Not(formula(f.operand, instant))
    if isinstance(f, (And, Or)):
        return (z3.And if isinstance(f, And) else z3.Or)([formula(o, instant) for o in f.operands])
    assert isinstance(f, Comparison)
    a, b = side(f.left, instant), side(f.right, instant)
    return {"<": a < b, "<=": a <= b, "=": a == b, "!=": a != b, ">=": a >= b, ">": a > b}[f.operator]


def side(term: Term, instant: Instant) -> Any:
    if isinstance(term, MeasureRef):
        return instant.measure(term.name)
    if isinstance(term, Calculated):
        summands = (z3.Product(factor, *map(instant.measure, names)) for factor, names in term.terms)
        return z3.Sum(*summands)
    return z3.IntVal(term.rank) if isinstance(term, ScaleValue) else number(term.value)


# Asking ---------------------------------------------------------------------------------------------------


def solve(parts: Sequence[Any], milliseconds: int = 60_000) -> Any:
    """A model, or None."""
    solver = z3.Solver()
    solver.set("timeout", milliseconds)
    solver.add(*parts)
    result = solver.check()
    if result == z3.unknown:
        raise Undecided(solver.reason_unknown())
    return solver.model() if result == z3.sat else None


def moments(instants: Instants, model: Any) -> tuple[Moment, ...]:
    def value(expression: Any) -> Any:
        return model.eval(expression, model_completion=True)

    found = []
    for i in instants:
        if not z3.is_true(value(i.used)):
            continue
        ruleset = i.ruleset
        conditions: dict[str, Any] = {name: z3.is_true(value(i.condition(name))) for name in ruleset.conditions}
        for name, measure in ruleset.measures.items():
            worth = value(i.measure(name)).as_fraction() if measure.kind == "number" else value(i.measure(name))
            if measure.kind != "number":
                worth = worth.as_long()
            conditions[name] = measure.values[worth] if measure.kind == "scale" else worth
        events = {name for name in ruleset.triggers | ruleset.obligations if z3.is_true(value(i.event(name)))}
        found.append(Moment(value(i.time).as_long(), frozenset(events), conditions))
    return tuple(found)


def _trace(ruleset: Ruleset, n: int, horizon: int | None) -> tuple[list[Instant], Any]:
    instants = [Instant(ruleset, f"i{k}") for k in range(n)]
    parts = [ordered(instants, first_used=True)]
    if horizon is not None:
        parts += [z3.Implies(i.used, i.time <= horizon) for i in instants]
    return instants, z3.And(parts)


def redundant(ruleset: Ruleset, label: str, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether no trace satisfies the other rules and breaks this one; `n` instants at most, none after `horizon`."""
    instants, possible = _trace(ruleset, n, horizon)
    meaning = Meaning(ruleset, instants, untimed)
    rule = ruleset.by_label[label]
    broken = z3.Or([z3.Not(meaning.law(rule, index)) for index in range(n)])
    model = solve([possible, meaning.all_rules(lambda law, index: law is rule), broken])
    return Answer(True) if model is None else Answer(False, moments(instants, model))


def vacuous(ruleset: Ruleset, label: str, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether the guard of this rule can be true, and no trace of all rules has it triggered."""
    instants, possible = _trace(ruleset, n, horizon)
    rule = ruleset.by_label[label]
    if rule.guard is not None and solve([possible, formula(rule.guard, instants[0])]) is None:
        return Answer(False)
    meaning = Meaning(ruleset, instants, untimed)
    model = solve([possible, meaning.all_rules(), z3.Or([meaning.triggered(rule, i) for i in instants])])
    return Answer(True) if model is None else Answer(False, moments(instants, model))


def concern(ruleset: Ruleset, claim: Claim, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether some trace of all rules brings this concern about."""
    instants, possible = _trace(ruleset, n, horizon)
    meaning = Meaning(ruleset, instants, untimed)
    model = solve([possible, meaning.all_rules(), meaning.claim(claim)])
    return Answer(False) if model is None else Answer(True, moments(instants, model))


def purpose(ruleset: Ruleset, claim: Claim, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether no trace of all rules brings this purpose about."""
    found, trace, _ = concern(ruleset, claim, n, untimed, horizon)
    return Answer(not found, trace)


# Conflicts ------------------------------------------------------------------------------------------------


def conflict(
    ruleset: Ruleset,
    label: str,
    past: int = 2,
    later: int = 2,
    longest: int = 4,
    untimed: str = "at",
    until: int | None = None,
    after: int | None = None,
    rounds: int = 500,
) -> Answer:
    """Whether a history in which no rule is broken so far, and this one is triggered now, has no continuation to a
    trace of all rules, but has one if this rule is let off now.

    The history has `past` instants at most before now, the continuation without the rule `later` ones after it, and
    those that are to be ruled out `longest`. Now is `until` at the latest, and the last instant of a continuation is so
    many seconds after it; by default that leaves room for all that can matter, by the lengths in the rules.
    """
    apart = 1 + _reach(ruleset)
    search = _Search(
        ruleset,
        ruleset.by_label[label],
        untimed,
        past * apart if until is None else until,
        max(later, longest) * apart if after is None else after,
    )
    history = [Instant(ruleset, f"past{k}") for k in range(past)] + [Instant(ruleset, "now")]
    return search.run(history, later, longest, rounds)


class _Search:
    def __init__(self, ruleset: Ruleset, rule: Rule, untimed: str, until: int, after: int) -> None:
        self.ruleset, self.rule, self.untimed, self.until, self.after = ruleset, rule, untimed, until, after

    def run(self, history: list[Instant], later: int, longest: int, rounds: int) -> Answer:
        now = history[-1]
        free = self.continuation(history, "free", later)
        proposals = z3.Solver()
        proposals.set("timeout", 60_000)
        proposals.add(
            ordered(history, first_used=False),
            now.used,
            now.time <= self.until,
            self.inside(history),
            Meaning(self.ruleset, history, self.untimed).triggered(self.rule, now),
            self.not_broken_so_far(history),
            self.follows(free),
            Meaning(self.ruleset, free, self.untimed).all_rules(
                lambda law, index: law is self.rule and free[index].name == "free.now"
            ),
        )
        full = self.continuation(history, "full", longest)
        follows = [self.follows(full), Meaning(self.ruleset, full, self.untimed).all_rules()]
        for _ in range(rounds):
            result = proposals.check()
            if result == z3.unknown:
                raise Undecided(proposals.reason_unknown())
            if result == z3.unsat:
                return Answer(False)
            proposed = proposals.model()
            found = solve([*follows, self.as_in(history, proposed)])
            if found is None:
                return Answer(True, moments(history, proposed), moments(free, proposed))
            proposals.add(z3.Not(self.fits(history, full, found)))
        raise Undecided(f"{rounds} histories, and each has a continuation of its own")

    def continuation(self, history: list[Instant], name: str, later: int) -> list[Instant]:
        """The past as it is, now with more events, and instants to come."""
        coming = [Instant(self.ruleset, f"{name}.later{k}") for k in range(later)]
        return [*history[:-1], Extended(history[-1], f"{name}.now"), *coming]

    def follows(self, instants: Instants) -> Any:
        """That the instants after now come after it."""
        at = next(index for index, i in enumerate(instants) if isinstance(i, Extended))
        coming = instants[at + 1 :]
        now = instants[at].time
        after = [z3.Implies(i.used, z3.And(i.time > now, i.time <= now + self.after)) for i in coming]
        return z3.And(*after, ordered(coming, first_used=True), self.inside(coming))

    def inside(self, instants: Instants) -> Any:
        """Numbers of a range, so that there are finitely many histories and continuations; the times have one."""
        parts = []
        for name, measure in self.ruleset.measures.items():
            if measure.kind != "scale":
                parts += [z3.And(i.measure(name) >= -10, i.measure(name) <= 10) for i in instants]
        return z3.And(parts)

    def not_broken_so_far(self, history: list[Instant]) -> Any:
        """Each statement at each instant has an extension of the history, of its own, that satisfies it there; of the
        rule that is asked about, each response of now."""
        parts = []
        stated = [
            (part, index)
            for law in laws(self.ruleset)
            for index in range(len(history))
            for part in (responses_apart(law) if law is self.rule and index == len(history) - 1 else (law,))
        ]
        for place, (law, index) in enumerate(stated):
            own = self.continuation(history, f"law{place}.at{index}", _occurrences(law))
            coming = own[len(history) :]
            parts.append(ordered([own[len(history) - 1], *coming], first_used=True) if coming else TRUE)
            parts.append(Meaning(self.ruleset, own, self.untimed).law(law, index))
        return z3.And(parts)

    def as_in(self, history: list[Instant], model: Any) -> Any:
        """That the history is the one of a model."""
        parts = []
        for i in history:
            known = Known(i, model, None)
            parts.append(i.time == model.eval(i.time, model_completion=True))
            parts.append(i.used == known.used)
            parts += [i.event(n) == known.event(n) for n in self.ruleset.triggers | self.ruleset.obligations]
            parts += [i.condition(n) == known.condition(n) for n in self.ruleset.conditions]
            parts += [i.measure(n) == known.measure(n) for n in self.ruleset.measures]
            # What only relations speak of is no trigger, obligation or condition of the ruleset, unless declared.
            parts += [d() == model[d] for d in model.decls() if d.name().startswith(f"{i.name}.")]
        return z3.And(parts)

    def fits(self, history: list[Instant], full: list[Instant], model: Any) -> Any:
        """That what a model continues its history with continues this one too, as long after now as there."""
        now = history[-1]
        extended = full[len(history) - 1]
        assert isinstance(extended, Extended)
        since = model.eval(now.time, model_completion=True)
        coming = [
            Known(i, model, now.time + (model.eval(i.time, model_completion=True) - since))
            for i in full[len(history) :]
            if z3.is_true(model.eval(i.used, model_completion=True))
        ]
        instants = [*history[:-1], More(now, extended, model), *coming]
        return Meaning(self.ruleset, instants, self.untimed).all_rules()


def _reach(ruleset: Ruleset) -> int:
    """More than any time between two instants that a statement compares."""

    def of_clause(clause: Clause) -> int:
        parts = [of_clause(hedge) for hedge in clause.hedges]
        for o in clause.obligations:
            window = None if o.timing is None else o.timing.window
            own = 0 if window is None else max(map(of_length, filter(None, (window.start, window.end))), default=0)
            parts.append(own + max(map(of_clause, [] if o.timing is None else o.timing.alternatives()), default=0))
        return max(parts, default=0)

    def of_length(length: Length) -> int:
        return int(length.amount.value if isinstance(length.amount, Number) else 10) * SECONDS[length.unit] + 1

    found = [0]
    for law in laws(ruleset):
        if isinstance(law, Rule):
            found += map(of_clause, (law.default, *law.hedges))
        elif isinstance(law, Lasting) and law.duration is not None:
            found.append(of_length(law.duration))
    return max(found)


def responses_apart(rule: Rule) -> list[Rule]:
    """The rule once for each response that one of its clauses has, without the others."""

    def only(clause: Clause, number: int) -> Clause:
        own = clause.obligations[number : number + 1]
        return replace(clause, obligations=own, hedges=tuple(only(hedge, number) for hedge in clause.hedges))

    most = max(len(clause.obligations) for clause in rule.clauses())
    return [
        replace(rule, default=only(rule.default, n), hedges=tuple(only(hedge, n) for hedge in rule.hedges))
        for n in range(most)
    ]


def _occurrences(law: Any) -> int:
    """How many events, at instants of their own, may be needed to keep a rule once; a relation needs none to come."""

    def of_clause(clause: Clause) -> int:
        own = sum(
            max(1, *map(of_clause, () if o.timing is None else o.timing.alternatives()), 0) for o in clause.obligations
        )
        return max(own, *map(of_clause, clause.hedges), 0)

    return max(map(of_clause, (law.default, *law.hedges))) if isinstance(law, Rule) else 0
