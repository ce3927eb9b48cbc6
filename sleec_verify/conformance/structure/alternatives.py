"""The obligations that alternatives require. Alternatives have no variants: the runtime calls callables for them, also
if the rule has a method."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.model import Clause, Rule, in_text_order


class AlternativeObligation(NamedTuple):
    """An obligation after ``otherwise`` or ``else`` in clause `number` of a rule. `branch` names the alternative."""

    name: str
    number: int
    branch: str


def alternative_obligations(rule: Rule) -> Iterator[AlternativeObligation]:
    """The obligations of all alternatives of a rule, also of nested ones and of their exceptions, in text order."""
    for number, clause in enumerate(rule.clauses()):
        for name, branch in _below(clause):
            yield AlternativeObligation(name, number, branch)


def _below(clause: Clause) -> Iterator[tuple[str, str]]:
    for obligation in clause.obligations:
        timing = obligation.timing
        if timing is None:
            continue
        for word, alternative in (("otherwise", timing.otherwise), ("else", timing.instead)):
            if alternative is None:
                continue
            branch = f"the `{word}` of {obligation}"
            for inner in in_text_order(alternative):
                where = branch if inner is alternative else f"an exception in {branch}"
                yield from ((literal.name, where) for literal in inner.obligations if not literal.negated)
                yield from _below(inner)
