"""Collects the findings. Each has a place in the code, or in the rules if there is no code."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field

from sleec_runtime.model import Rule, Ruleset, Span, obligation_text
from sleec_verify.conformance.structure.kinds import KINDS
from sleec_verify.conformance.structure.target import PythonFile
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.wording.phrases import listed

NAME = "structure"


@dataclass
class Findings:
    """The findings on one target, each once."""

    ruleset: Ruleset
    _found: dict[tuple[object, ...], Finding] = field(default_factory=dict)

    def add(
        self,
        kind: str,
        message: str,
        at: tuple[PythonFile, ast.AST] | None,
        *,
        rules: tuple[str, ...] = (),
        clause: ClauseRef | None = None,
        obligations: tuple[str, ...] = (),
        span: Span | None = None,
        note: str | None = None,
        help: str | None = None,
        related: tuple[tuple[Span, str], ...] = (),
    ) -> None:
        """A finding at a node of a file; without one, at `span` of the rules."""
        source = None if at is None else at[0].source
        place = at[0].span(at[1]) if at is not None else span or Span(0, 0)
        if clause is not None and not rules:
            rules = (clause.rule,)
        finding = Finding(
            NAME,
            KINDS[kind].code,
            KINDS[kind].severity,
            message,
            place,
            rules,
            () if clause is None else (clause,),
            obligations,
            note=note,
            help=help,
            related=related,
            source=source,
        )
        path = None if source is None else source.path
        self._found.setdefault((finding.code, path, place, message), finding)

    def undecided(self, file: PythonFile, node: ast.AST, why: str) -> None:
        """Reports code that cannot be checked without running it."""
        self.add("undecided", f"this cannot be decided without running the code: {why}", (file, node))

    @property
    def found(self) -> tuple[Finding, ...]:
        """All of them, by file and place; those about the rules first."""
        return tuple(
            sorted(self._found.values(), key=lambda f: ("" if f.source is None else f.source.path, f.span, f.code))
        )

    def obliged(self, rule: Rule, number: int) -> str:
        """The obligations of a clause in words, with its place in the rules."""
        clause = tuple(rule.clauses())[number]
        names = [obligation_text(literal) for literal in clause.obligations]
        source = self.ruleset.source
        what = f"requires {listed(names)}" if names else "requires nothing"
        return f"{clause_name(rule, number)} {what} ({source.path}:{source.place(clause.span).line})"


def clause_name(rule: Rule, number: int) -> str:
    """The layer of a clause, which is its name in the code."""
    return rule.layer(number) or f"the default of {rule.label}"


def expression(rule: Rule, number: int) -> str:
    """The decorator that binds a variant to a clause."""
    layer = rule.layer(number)
    return "@cop.base" if layer is None else f'@cop.around(sleec.layers["{layer}"])'
