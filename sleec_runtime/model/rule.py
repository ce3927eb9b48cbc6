"""Rules: a trigger, a guard, and a chain of clauses (paper, Section 3.2).

A rule has a trigger C0, a default response O0, and hedge clauses ``UNLESS Ci IN WHICH CASE Oi``. Clause 0 is the
default. Clauses 1 to n are the hedges in text order.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from sleec_runtime.model.comments import NO_COMMENTS, Comments
from sleec_runtime.model.formula import Formula
from sleec_runtime.model.response import Clause, conditions_in, in_text_order
from sleec_runtime.support.spans import NOWHERE, Span


@dataclass(frozen=True, slots=True)
class Rule:
    """``WHEN trigger [AND guard] THEN default UNLESS hedges…`` (paper, Section 3.2).

    `domains` is None for a rule that applies in every domain. `labelled` is False if the text gives no label; `label`
    is then the number of the rule in the file (``rule_3``). `always` is the name of the ALWAYS statement of which this
    rule is the instance for its trigger (``always_1``).
    """

    label: str
    trigger: str
    guard: Formula | None
    default: Clause
    hedges: tuple[Clause, ...]
    domains: tuple[str, ...] | None = None
    labelled: bool = True
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    label_span: Span = field(default=NOWHERE, compare=False, repr=False)
    trigger_span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)
    always: str | None = None

    @property
    def heading_span(self) -> Span:
        """The place of the label, or of the whole rule if the text gives no label."""
        return self.label_span if self.labelled else self.span

    def clauses(self) -> Iterator[Clause]:
        """Every clause in text order, nested ones after the clause that holds them. The index of a clause is its
        number: 0 is the default, i has the layer ``label.hci``."""
        for clause in (self.default, *self.hedges):
            if clause.hedges:
                yield from in_text_order(clause)
            else:
                yield clause

    def layer(self, number: int) -> str | None:
        """The name of the layer of clause `number`; None for the default, which has the ε of the rule."""
        return f"{self.label}.hc{number}" if number else None

    def applies_in(self, domain: str | None) -> bool:
        """Whether the rule applies in `domain`. Every rule applies if `domain` is None."""
        return domain is None or self.domains is None or domain in self.domains


def formulas_of(rule: Rule) -> Iterator[Formula]:
    """The guard and the conditions of a rule, in text order."""
    if rule.guard is not None:
        yield rule.guard
    for clause in rule.clauses():
        yield from conditions_in(clause)
