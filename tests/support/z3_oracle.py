"""The questions about rules with times by z3: some instants with symbolic times, and what the rules say written down
for each. It borrows the values of the product and nothing else. Bounded, slow, and written to be obviously right.

A trace that it finds is one, whatever the bound. That it finds none means: none of so few instants.

`redundant`, `vacuous`, `concern` and `purpose` look for one trace. `conflict` asks for a situation in which no response
complies with some rules: one solver proposes situations, another looks for a response, and what it finds is kept in the
first as a response that the next situation must not have (counterexample-guided refinement of ∃∀).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import z3

from sleec_runtime.model import (
    RELATIONS,
    SECONDS,
    And,
    Assume,
    Atom,
    Calculation,
    Claim,
    Clause,
    Comparison,
    Declaration,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    MeasureRef,
    MeasureRelation,
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
    literals,
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
    """

    found: bool
    moments: tuple[Moment, ...] | None = None


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
    if isinstance(term, Calculation):
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
    found, trace = concern(ruleset, claim, n, untimed, horizon)
    return Answer(not found, trace)


# Conflicts ------------------------------------------------------------------------------------------------


def conflict(
    ruleset: Ruleset, labels: Iterable[str], past: int = 2, later: int = 3, longest: int = 4, rounds: int = 300
) -> Answer:
    """Whether these rules are in conflict: in some situation no response complies with them, and one complies with each
    set that lacks one of them (docs/times.md).

    The history has `past` instants at most before now. A response that is looked for has `later` instants at most after
    now, and one that must not exist has `longest`.
    """
    apart = 1 + _reach(ruleset)
    rules = [ruleset.by_label[label] for label in labels]
    search = _Search(ruleset, rules, past * apart, max(later, longest) * apart)
    history = [Instant(ruleset, f"past{k}") for k in range(past)] + [Instant(ruleset, "now")]
    return search.run(history, later, longest, rounds)


class Quiet(Instant):
    """An instant as another one, but that no event has occurred at yet."""

    def __init__(self, base: Instant) -> None:
        super().__init__(base.ruleset, base.name)
        self.time, self.used = base.time, base.used

    def event(self, name: str) -> Any:
        return FALSE


class _Search:
    def __init__(self, ruleset: Ruleset, rules: Sequence[Rule], until: int, after: int) -> None:
        self.ruleset, self.rules, self.until, self.after = ruleset, rules, until, after
        self.triggers = {rule.trigger for rule in ruleset.rules}
        declared = {name for s in ruleset.statements if isinstance(s, Declaration) for name in s.names}
        self.acts = {o.name for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause)}
        self.events = self.triggers | self.acts | declared

    def run(self, history: list[Instant], later: int, longest: int, rounds: int) -> Answer:
        now = history[-1]
        proposals = z3.Solver()
        proposals.set("timeout", 60_000)
        proposals.add(ordered(history, first_used=False), now.used, now.time <= self.until, self.inside(history))
        speaking = Meaning(self.ruleset, history, "at")
        proposals.add(z3.Or([speaking.triggered(rule, now) for rule in self.rules]))
        own = {rule.trigger for rule in self.rules}
        proposals.add([z3.Not(now.event(name)) for name in self.events - own])
        proposals.add(self.lawful(history))
        for number, rule in enumerate(self.rules):
            proposals.add(self.response(history, f"without{number}", later, [r for r in self.rules if r is not rule]))
        full = self.continuation(history, "full", longest)
        follows = self.response(history, "full", longest, self.rules)
        for _ in range(rounds):
            result = proposals.check()
            if result == z3.unknown:
                raise Undecided(proposals.reason_unknown())
            if result == z3.unsat:
                return Answer(False)
            proposed = proposals.model()
            found = solve([follows, self.as_in(history, proposed)])
            if found is None:
                return Answer(True, moments(history, proposed))
            proposals.add(z3.Not(self.fits(history, full, found)))
        raise Undecided(f"{rounds} histories, and each has a continuation of its own")

    def counting(self, rules: Sequence[Rule]) -> Callable[[Any, int], bool]:
        """What does not count where only these rules do."""
        return lambda law, index: isinstance(law, Rule) and all(law is not rule for rule in rules)

    def response(self, history: list[Instant], name: str, later: int, rules: Sequence[Rule]) -> Any:
        """That a response complies with these rules and with all relations."""
        instants = self.continuation(history, name, later)
        complies = Meaning(self.ruleset, instants, "at").all_rules(self.counting(rules))
        return z3.And(self.follows(instants), complies, self.only_acts(history[-1], instants[len(history) - 1]))

    def only_acts(self, now: Instant, extended: Instant) -> Any:
        """That a response adds no event now that only triggers rules."""
        return z3.And([extended.event(name) == now.event(name) for name in self.triggers - self.acts])

    def lawful(self, history: list[Instant]) -> Any:
        """Each statement at each instant has an extension of the history, of its own, that satisfies it there. The
        inputs of now count only for the rules asked about."""
        *past, now = history
        parts = []
        for place, law in enumerate(laws(self.ruleset)):
            given = now if any(law is rule for rule in self.rules) else Quiet(now)
            for index in range(len(past)):
                own = self.continuation([*past, given], f"law{place}.at{index}", _occurrences(law))
                coming = own[len(history) :]
                parts.append(ordered([own[len(past)], *coming], first_used=True) if coming else TRUE)
                parts.append(Meaning(self.ruleset, own, "at").law(law, index))
        return z3.And(*parts, self.response(history, "relations", 2, []))

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
        return Meaning(self.ruleset, instants, "at").all_rules(self.counting(self.rules))


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


def _occurrences(law: Any) -> int:
    """How many events, at instants of their own, may be needed to keep a rule once; a relation needs none to come."""

    def of_clause(clause: Clause) -> int:
        own = sum(
            max(1, *map(of_clause, () if o.timing is None else o.timing.alternatives()), 0) for o in clause.obligations
        )
        return max(own, *map(of_clause, clause.hedges), 0)

    return max(map(of_clause, (law.default, *law.hedges))) if isinstance(law, Rule) else 0
