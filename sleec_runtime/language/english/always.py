"""Rules for every trigger: ``ALWAYS response UNLESS condition IN WHICH CASE response …``.

An ALWAYS statement stands for one rule for each trigger of the text. These rules are its instances.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from sleec_runtime.language.english.constraints import EnglishConstraintParser
from sleec_runtime.model import NO_COMMENTS, NOWHERE, Clause, Comments, Rule, Span

_NO_LABEL = re.compile(r"\W+")


class Always(NamedTuple):
    """An ALWAYS statement as it is written."""

    default: Clause
    hedges: tuple[Clause, ...]
    domains: tuple[str, ...] | None
    span: Span
    keyword: Span
    comments: Comments


class EnglishAlwaysParser(EnglishConstraintParser):
    """Reads ALWAYS statements. They apply to the domains that are set."""

    def always(self) -> Always:
        first = self.at
        self.at += 1
        self._unbalanced = False
        obligations, inner = self.response()
        default = Clause(None, obligations, inner, self.span(first))
        end = self.at
        self._end_of_clause("AND, UNLESS or the next statement")
        hedges: list[Clause] = []
        while self.kinds[self.at] == "UNLESS":
            hedges.append(self.hedge())
            end = self.at
            self._end_of_clause("AND, UNLESS or the next statement")
        span = Span(self.starts[first], self.ends[end - 1])
        return Always(default, tuple(hedges), self.domains, span, self.token_span(first), self.comments_of(first))


def instances(statement: Always, name: str, triggers: Iterable[str]) -> list[Rule]:
    """One rule for each of these triggers. `name` is that of the statement, whose comments the first one has."""
    labels: set[str] = set()
    rules: list[Rule] = []
    for trigger in triggers:
        label = base = f"{name}_{_NO_LABEL.sub('_', trigger).strip('_')}"
        number = 1
        while label in labels:
            number += 1
            label = f"{base}_{number}"
        labels.add(label)
        rules.append(
            Rule(
                label,
                trigger,
                None,
                statement.default,
                statement.hedges,
                statement.domains,
                labelled=False,
                always=name,
                span=statement.span,
                label_span=NOWHERE,
                trigger_span=statement.keyword,
                comments=NO_COMMENTS if rules else statement.comments,
            )
        )
    return rules
