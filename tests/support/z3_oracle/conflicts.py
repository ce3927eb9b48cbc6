"""Conflicts, by z3: one solver proposes situations, another one looks for a response."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import z3

from sleec_runtime.model import (
    SECONDS,
    Clause,
    Declaration,
    Lasting,
    Length,
    Number,
    Rule,
    Ruleset,
    literals,
)
from tests.support.z3_oracle.instants import (
    FALSE,
    TRUE,
    Answer,
    Extended,
    Instant,
    Instants,
    Known,
    More,
    Undecided,
    ordered,
)
from tests.support.z3_oracle.meaning import Meaning, laws
from tests.support.z3_oracle.questions import moments, solve


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
