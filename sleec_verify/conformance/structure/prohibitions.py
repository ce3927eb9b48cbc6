"""Prohibitions with a window: which acts the rules forbid for a time."""

from __future__ import annotations

import ast
from collections.abc import Iterable

from sleec_runtime.model import Rule, literals, obligation_text
from sleec_verify.conformance.structure.own_conditions import OwnConditions
from sleec_verify.conformance.structure.report import Findings
from sleec_verify.conformance.structure.uses import Use
from sleec_verify.wording.phrases import listed


class LastingProhibitions:
    """The acts that `rules` forbid for a time. The runtime rejects their dispatch in that time, and nothing else."""

    def __init__(self, rules: Iterable[Rule], findings: Findings, conditions: OwnConditions) -> None:
        self._findings = findings
        self._conditions = conditions
        self._forbidding: dict[str, dict[str, str]] = {}
        """For each act, the labels of the rules that forbid it, with the text of one prohibition."""
        self.required: set[str] = set()
        """What the rules require in some situation."""
        for rule in rules:
            for clause in rule.clauses():
                for literal in literals(clause):
                    if not literal.negated:
                        self.required.add(literal.name)
                    elif literal.timing is not None and literal.timing.window is not None:
                        line = findings.ruleset.source.place(literal.span).line
                        text = f"{rule.label} requires {obligation_text(literal)}"
                        place = f"{findings.ruleset.source.path}:{line}"
                        self._forbidding.setdefault(literal.name, {}).setdefault(rule.label, f"{text} ({place})")

    def __contains__(self, act: object) -> bool:
        return act in self._forbidding

    @property
    def acts(self) -> frozenset[str]:
        """What rules forbid for a time."""
        return frozenset(self._forbidding)

    def labels(self, act: str) -> tuple[str, ...]:
        """The rules that forbid an act for a time."""
        return tuple(self._forbidding.get(act, ()))

    def forbid_it(self, act: str) -> str:
        """``rest forbids it``, ``rest and night forbid it``"""
        labels = self.labels(act)
        return f"{listed(labels)} {'forbids' if len(labels) == 1 else 'forbid'} it"

    def report(self, act: str, node: ast.AST, use: Use) -> None:
        """Reports code that executes an act outside a dispatch, at `node` in the expression `use`. No rule requires the
        act, so the code may execute it at other times."""
        condition = self._conditions.around(use)
        if condition is not None:
            why = f"{act} is executed here {condition}, perhaps while {self.forbid_it(act)}"
            self._findings.undecided(use.scope.file, node, why)
            return
        self._findings.add(
            "unguarded-act",
            f"{act} is executed here, also while {self.forbid_it(act)}",
            (use.scope.file, node),
            rules=self.labels(act),
            obligations=(act,),
            note=self.note([act]),
            help="write a rule that requires it, and trigger this rule: then the runtime rejects it at these times",
        )

    def note(self, acts: Iterable[str]) -> str | None:
        """The prohibitions of `acts` in words; None if there are none."""
        found = [text for act in acts for text in self._forbidding.get(act, {}).values()]
        return listed(found) if found else None
