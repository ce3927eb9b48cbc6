"""A ruleset without comparisons as the theory's values: names as numbers, written as a line for the oracle, or in Coq.

Both ways to write it are walks over the same rules. A default with a chain of its own is written as a first hedge
under ``true``: that this is the same is a theorem (`default_as_hedge` in `proofs/oracle/Certified.v`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

from sleec_runtime.model import (
    And,
    Atom,
    Clause,
    Constraint,
    Exclusive,
    Formula,
    Never,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
    Truth,
)

Kind = Literal["trigger", "condition", "obligation", "rule"]
LETTERS: dict[str, str] = {"trigger": "t", "condition": "c", "obligation": "o"}


class Numbering:
    """`names` are the names of each kind in the order of their first use. The position, from 1, is the number."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._ruleset = ruleset
        self._numbers: dict[Kind, dict[str, int]] = {"rule": {}, "trigger": {}, "condition": {}, "obligation": {}}
        # Writing it numbers the names.
        words = [word for rule in ruleset.rules for word in self._rule_words(rule)]
        words += [str(len(ruleset.constraints))]
        words += [word for constraint in ruleset.constraints for word in self._constraint_words(constraint)]
        counts = (ruleset.reading, len(self._numbers["obligation"]), len(ruleset.rules))
        self.line = " ".join(("rules", *map(str, counts), *words))

    @property
    def names(self) -> dict[Kind, Sequence[str]]:
        return {kind: tuple(numbers) for kind, numbers in self._numbers.items()}

    def question(self, word: str, facts: Iterable[Atom]) -> str:
        """A question of the oracle about the context in which these facts, and no others, are true."""
        known = [f for f in dict.fromkeys(facts) if f.name in self._numbers[f.kind]]
        return f"{word} {len(known)}" + "".join(f" {LETTERS[f.kind]} {self._numbers[f.kind][f.name]}" for f in known)

    def rule(self, label: str) -> int:
        """The number of a rule."""
        return self._numbers["rule"][label]

    def literal(self, number: int) -> Obligation:
        """The name of a number in an answer of the oracle."""
        return Obligation(self.names["obligation"][abs(number) - 1], number < 0)

    def _number(self, kind: Kind, name: str) -> int:
        numbers = self._numbers[kind]
        return numbers.setdefault(name, len(numbers) + 1)

    # A line for the oracle ------------------------------------------------------------------------------------

    def _rule_words(self, rule: Rule) -> Iterator[str]:
        yield str(self._number("rule", rule.label))
        yield str(self._number("trigger", rule.trigger))
        yield from self._formula_words(Truth(True) if rule.guard is None else rule.guard)
        yield from self._chain_words(rule.default, rule.hedges)

    def _chain_words(self, default: Clause, hedges: Sequence[Clause]) -> Iterator[str]:
        literals, inner = _chain(default, hedges)
        yield str(len(literals))
        for literal in literals:
            yield str(self._signed(literal))
        yield str(len(inner))
        for condition, clause in inner:
            yield from self._formula_words(condition)
            yield from self._chain_words(*_member(clause))

    def _signed(self, literal: Obligation) -> int:
        number = self._number("obligation", literal.name)
        return -number if literal.negated else number

    def _constraint_words(self, constraint: Constraint) -> Iterator[str]:
        if isinstance(constraint, Exclusive):
            yield from ("E", str(len(constraint.names)))
            yield from (str(self._number("obligation", name)) for name in constraint.names)
        else:
            yield "N" if isinstance(constraint, Never) else "A"
            yield from self._formula_words(constraint.formula)

    def _formula_words(self, formula: Formula) -> Iterator[str]:
        if isinstance(formula, Atom):
            yield from (LETTERS[formula.kind], str(self._number(formula.kind, formula.name)))
        elif isinstance(formula, Not):
            yield "!"
            yield from self._formula_words(formula.operand)
        elif isinstance(formula, (And, Or)):
            for operand in formula.operands[:-1]:
                yield "&" if isinstance(formula, And) else "|"
                yield from self._formula_words(operand)
            yield from self._formula_words(formula.operands[-1])
        else:
            assert isinstance(formula, Truth), "comparisons are conditions here"
            yield str(int(formula.value))

    # Coq ------------------------------------------------------------------------------------------------------

    def coq_rules(self) -> str:
        """The rules as a Coq list, a rule below the other."""
        return _listed("  ", (self._coq_rule(rule) for rule in self._ruleset.rules))

    def coq_constraints(self) -> str:
        """The constraints as a Coq list."""
        return _listed("  ", (self._coq_constraint(constraint) for constraint in self._ruleset.constraints))

    def _coq_rule(self, rule: Rule) -> str:
        guard = self._coq_formula(Truth(True) if rule.guard is None else rule.guard, "({fact})")
        label, trigger = self._number("rule", rule.label), self._number("trigger", rule.trigger)
        return f"NestedRule {label} {trigger} {guard}\n     {self._coq_chain(rule.default, rule.hedges, ' ' * 6)}"

    def _coq_chain(self, default: Clause, hedges: Sequence[Clause], indent: str) -> str:
        literals, inner = _chain(default, hedges)
        obliged = "; ".join(
            f"{'Avoid' if literal.negated else 'Do'} {abs(self._signed(literal))}" for literal in literals
        )
        members = (
            f"({self._coq_formula(condition, '({fact})')}, {self._coq_chain(*_member(clause), indent + '  ')})"
            for condition, clause in inner
        )
        return f"(Chain [{obliged}]{_listed(indent, members)})"

    def _coq_constraint(self, constraint: Constraint) -> str:
        if isinstance(constraint, Exclusive):
            return f"Exclusive [{'; '.join(str(self._number('obligation', name)) for name in constraint.names)}]"
        if isinstance(constraint, Never):
            return f"Never {self._coq_formula(constraint.formula, '({atom})')}"
        return f"Assume {self._coq_formula(constraint.formula, '({fact})')}"

    def _coq_formula(self, formula: Formula, atom: str) -> str:
        if isinstance(formula, Atom):
            number = self._number(formula.kind, formula.name)
            fact = f"{'Occurs' if formula.kind == 'trigger' else 'Holds'} {number}"
            whole = f"Done {number}" if formula.kind == "obligation" else f"Fact ({fact})"
            return f"(Atom {atom.format(number=number, fact=fact, atom=whole)})"
        if isinstance(formula, Not):
            return f"(Not {self._coq_formula(formula.operand, atom)})"
        if isinstance(formula, (And, Or)):
            word = "And" if isinstance(formula, And) else "Or"
            *front, last = (self._coq_formula(operand, atom) for operand in formula.operands)
            return "".join(f"({word} {operand} " for operand in front) + last + ")" * len(front)
        assert isinstance(formula, Truth), "comparisons are conditions here"
        return f"(Truth {str(formula.value).lower()})"


def _chain(default: Clause, hedges: Sequence[Clause]) -> tuple[tuple[Obligation, ...], list[tuple[Formula, Clause]]]:
    """What the theory's chain obliges, and its members with their conditions."""
    members = [(hedge.condition, hedge) for hedge in hedges if hedge.condition is not None]
    if default.hedges and hedges:
        return (), [(Truth(True), default), *members]
    if default.hedges:
        return _chain(*_member(default))
    return default.obligations, members


def _member(clause: Clause) -> tuple[Clause, Sequence[Clause]]:
    """A clause as the default of the chain inside it."""
    return Clause(clause.condition, clause.obligations), clause.hedges


def _listed(indent: str, items: Iterable[str]) -> str:
    written = list(items)
    return f"\n{indent}[ " + f";\n{indent}  ".join(written) + " ]" if written else " []"
