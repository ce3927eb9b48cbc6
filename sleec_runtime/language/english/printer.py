"""From values back to text, in one canonical form: what is printed parses to the same ruleset, and prints the same.

One clause a line, a blank line between rules, and parentheses only where they are needed, except around a response of
several obligations behind IN WHICH CASE and a guard with OR, which people read more easily with them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Union

from sleec_runtime.language.common.formula_printer import guard_text, print_formula, print_number
from sleec_runtime.language.common.line_printer import behind, comment_lines, split_heading, trimmed
from sleec_runtime.language.english.chain_printer import ChainPrinter
from sleec_runtime.model import (
    NO_COMMENTS,
    Assume,
    Claim,
    Comments,
    Constant,
    Declaration,
    Exclusive,
    Measure,
    Never,
    Relation,
    Rule,
    Ruleset,
    Statement,
)

_BesideRules = Union[Declaration, Measure, Constant, Exclusive, Never, Assume, "Claim", "Relation"]


def print_ruleset(ruleset: Ruleset) -> str:
    """`ruleset` as a text in its own syntax, with its comments, ending in a line break (or empty).

    Raises:
        Unsayable: something in it cannot be said in that syntax.
    """
    if ruleset.syntax == "dsl":
        from sleec_runtime.language.dsl.printer import print_dsl

        return print_dsl(ruleset)
    return "".join(f"{line}\n" for line in _Printer(comments=True).ruleset(ruleset))


def print_rule(rule: Rule) -> str:
    """One rule as text, without its comments, its domains, and a label that is only its number."""
    return "\n".join(_Printer(comments=False).rule(rule, rule.labelled))


class _Printer:
    def __init__(self, comments: bool) -> None:
        self._with_comments = comments

    def ruleset(self, ruleset: Ruleset) -> Iterator[str]:
        """The lines of a whole text."""
        settings: list[str] = []
        if ruleset.reading_stated or ruleset.reading != "cascade":
            settings.append(f"READING {ruleset.reading}")
        domains: tuple[str, ...] | None = None
        before: Statement | None = None
        rules = 0
        for statement in ruleset.statements:
            if isinstance(statement, (Rule, Exclusive, Never, Assume)) and statement.domains != domains:
                domains = statement.domains
                settings.append(f"DOMAIN {', '.join(domains) if domains is not None else 'everywhere'}")
            labelled = False
            if isinstance(statement, Rule):
                rules += 1
                labelled = statement.labelled or statement.label != f"rule_{rules}"
            heading, above = split_heading(_above(statement, labelled), bool(settings))
            if before is not None and (settings or _stands_apart(before, statement)):
                yield ""
            if settings:
                yield from comment_lines(heading)
                if heading and before is None:
                    yield ""
                yield from settings
                yield ""
                settings = []
            yield from comment_lines(above)
            yield from self.rule(statement, labelled) if isinstance(statement, Rule) else _other(statement)
            before = statement
        closing = trimmed(ruleset.closing_comments)
        if closing:
            if before is not None:
                yield ""
            yield from comment_lines(closing)

    def rule(self, rule: Rule, labelled: bool) -> Iterator[str]:
        """The lines of a rule, without the comments above it."""
        own = rule.comments if self._with_comments else NO_COMMENTS
        first = rule.default.comments if self._with_comments else NO_COMMENTS
        if labelled:
            yield behind(f"RULE {rule.label}", own.behind)
            yield from comment_lines(trimmed(first.above))
            remark = first.behind
        else:
            remark = first.behind if own.behind is None else own.behind
        lines = ChainPrinter(self._with_comments)
        lines.begin("", Comments(behind=remark))
        lines.write(f"WHEN {rule.trigger}{guard_text(rule.guard)} THEN ")
        lines.response(rule.default)
        lines.hedges(rule.hedges)
        yield from lines.lines()


def _other(statement: _BesideRules) -> Iterator[str]:
    """The lines of a statement that is no rule, without the comments above it."""
    if isinstance(statement, (Declaration, Measure, Constant, Exclusive, Never, Assume)):
        yield behind(_statement(statement), statement.comments.behind)
        return
    from sleec_runtime.language.english.relations_printer import print_beside_rules

    yield from print_beside_rules(statement)


def _statement(statement: Declaration | Measure | Constant | Exclusive | Never | Assume) -> str:
    if isinstance(statement, Declaration):
        agent = f" BY {statement.agent}" if statement.agent is not None else ""
        return f"{statement.kind.upper()} {', '.join(statement.names)}{agent}"
    if isinstance(statement, Measure):
        return f"MEASURE {statement.name}: {' < '.join(statement.values) or statement.kind}"
    if isinstance(statement, Constant):
        return f"CONSTANT {statement.name} = {statement.alias or print_number(statement.value)}"
    if isinstance(statement, Exclusive):
        return f"EXCLUSIVE {', '.join(statement.names)}"
    return f"{'NEVER' if isinstance(statement, Never) else 'ASSUME'} {print_formula(statement.formula)}"


def _stands_apart(before: Statement, statement: Statement) -> bool:
    """Whether a blank line separates two statements: rules stand alone, others in groups of one kind."""
    return isinstance(statement, Rule) or _group(before) != _group(statement)


def _group(statement: Statement) -> str:
    if isinstance(statement, (Rule, Declaration, Measure, Constant, Exclusive, Never, Assume)):
        return type(statement).__name__
    # A concern or a purpose, or one of the relations.
    return getattr(statement, "kind", "relation")


def _above(statement: Statement, labelled: bool) -> Sequence[str]:
    """The comments above a statement. A rule without a label has no line apart from its default's: the comments of both
    stand above it, and the one too many behind it, too."""
    if not isinstance(statement, Rule) or labelled:
        return statement.comments.above
    own, default = statement.comments, statement.default.comments
    one_too_many = default.behind if own.behind is not None else None
    above = (*own.above, *default.above)
    return (*above, one_too_many) if one_too_many else above
