"""The oracle: what is due in a context, by Equation 1 and the solver. It runs no code of the runtime."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice

from sleec_runtime.model import Assume, Context, Exclusive, Never, Obligation, Rule, Ruleset, require_untimed
from sleec_verify.entailment.definition1 import Definition1
from sleec_verify.query.inconsistent_sets import InconsistentSet
from sleec_verify.query.prime_implicates import inconsistent_sets

_KEPT = 512
"""The number of compiled sets of triggers that are cached, because a suite uses few of them repeatedly."""


@dataclass(frozen=True)
class ActiveClause:
    """An active clause, with its layer (None is the rule's ε) and all of its obligations."""

    rule: str
    clause: int
    layer: str | None
    obligations: tuple[Obligation, ...]


@dataclass(frozen=True)
class Expectation:
    """The answer of Definition 1 for one context.

    `due` is in the order of the rules and of their clauses, with a name once for each rule that obliges it. In a
    `conflict`, nothing is due. `possible` is False if the context violates an assumption: it does not count.
    """

    active: tuple[ActiveClause, ...]
    due: tuple[str, ...]
    prohibited: tuple[str, ...]
    conflict: bool
    possible: bool


class Oracle:
    """The rules of one domain, compiled for each set of triggers at its first use.

    `whole` is the ruleset with all domains: its names can occur and be reported in any of them. Raises `Undecided` if
    the constraints are too entangled.
    """

    def __init__(self, whole: Ruleset, domain: str | None = None) -> None:
        require_untimed(whole, "a test of the executed obligations")
        self.whole = whole
        self.domain = domain
        self.ruleset = whole if domain is None else whole.in_domain(domain)
        forbidding = (c for c in self.ruleset.constraints if isinstance(c, (Exclusive, Never)))
        obliged = {o for rule in self.ruleset.rules for clause in rule.clauses() for o in clause.obligations}
        self.clashes = inconsistent_sets(forbidding, obliged)
        self.assumptions = [c.formula for c in self.ruleset.constraints if isinstance(c, Assume)]
        self._by_trigger: dict[str, list[Rule]] = {}
        for rule in self.ruleset.rules:
            self._by_trigger.setdefault(rule.trigger, []).append(rule)
        self._position = {rule.label: position for position, rule in enumerate(self.ruleset.rules)}
        self._compiled: dict[tuple[frozenset[str], frozenset[str]], _Compiled] = {}

    def rules_of(self, triggers: Iterable[str]) -> list[Rule]:
        """The rules of these triggers, in their order."""
        rules = [rule for trigger in triggers for rule in self._by_trigger.get(trigger, ())]
        return sorted(rules, key=lambda rule: self._position[rule.label])

    def clashes_among(self, literals: Iterable[Obligation]) -> list[InconsistentSet]:
        """The inconsistent sets of these literals, with those that a situation causes by itself."""
        return list(self.clashes.among(frozenset(literals)))

    def expected(self, context: Context) -> Expectation:
        """The answer of Definition 1 in `context`, by two propagations."""
        return self._ready(context).expected(context)

    def possible(self, context: Context) -> bool:
        """Whether `context` satisfies the assumptions."""
        return not self.assumptions or self.expected(context).possible

    def _ready(self, context: Context) -> _Compiled:
        missing = frozenset(name for name in self.whole.measures if context.conditions.get(name) is None)
        key = context.triggers, missing
        ready = self._compiled.get(key)
        if ready is None:
            if len(self._compiled) >= _KEPT:
                self._compiled.clear()
            ready = self._compiled[key] = _Compiled(self, self.rules_of(context.triggers), missing)
        return ready


class _Compiled:
    def __init__(self, oracle: Oracle, rules: list[Rule], missing: frozenset[str]) -> None:
        self._clauses = {rule.label: list(rule.clauses()) for rule in rules}
        literals = {o for clauses in self._clauses.values() for clause in clauses for o in clause.obligations}
        self._clashes = oracle.clashes_among(literals)
        labels = [label for clash in self._clashes for label in clash.labels]
        self._assumed = len(oracle.assumptions)
        self._definition = Definition1(oracle.ruleset, rules, [*oracle.assumptions, *labels], missing)

    def expected(self, context: Context) -> Expectation:
        definition = self._definition
        true = definition.facts(context)
        truths = [true(literal) for literal in definition.formulas]
        active = tuple(
            ActiveClause(rule.label, number, rule.layer(number), self._clauses[rule.label][number].obligations)
            for rule, guards in definition.guards
            if rule.label in self._clauses
            for number, guard in enumerate(guards)
            if true(guard)
        )
        possible = all(truths[: self._assumed])
        entailed = definition.entailed(context)
        if entailed is None or self._clash(entailed, iter(truths[self._assumed :])):
            return Expectation(active, (), (), True, possible)
        due = tuple(o.name for one in active for o in one.obligations if not o.negated)
        if set(due) != {o.name for o in entailed if not o.negated}:
            raise AssertionError(f"the guards and Equation 1 disagree in {context}; this is a bug in sleec-verify")
        return Expectation(active, due, tuple(sorted(o.name for o in entailed if o.negated)), False, possible)

    def _clash(self, entailed: frozenset[Obligation], truths: Iterator[bool]) -> bool:
        """Whether all literals of some inconsistent set are due. `truths` are those of its labels and of the next
        ones', in order."""
        situations = [all(list(islice(truths, len(clash.labels)))) for clash in self._clashes]
        return any(here and clash.literals <= entailed for clash, here in zip(self._clashes, situations))
