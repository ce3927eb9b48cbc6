"""A ruleset in structured English as text, in one canonical form.

The text parses to the same ruleset, and prints the same again. There is one clause per line, a blank line between
rules, and parentheses only where they are needed. Two exceptions make it easier to read: a response of several
obligations after IN WHICH CASE, and a guard with OR.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from sleec_runtime.language.common.comment_lines import comment_lines, split_heading, trimmed, with_comment
from sleec_runtime.language.common.formula_printer import print_formula, print_number
from sleec_runtime.language.english.statement_printer import EnglishPrinter
from sleec_runtime.model import (
    NO_COMMENTS,
    And,
    Assume,
    Claim,
    Constant,
    Declaration,
    Exclusive,
    Measure,
    Never,
    Not,
    Rule,
    Ruleset,
    Statement,
)


def print_english(ruleset: Ruleset) -> str:
    """`ruleset` as a text in structured English, with its comments, ending in a line break (or empty)."""
    return "".join(f"{line}\n" for line in _Printer(comments=True).ruleset(ruleset))


def print_rule(rule: Rule) -> str:
    """One rule as text, without its comments, its domains, and a label that is only its number."""
    return "\n".join(_Printer(comments=False).rule(replace(rule, always=None), rule.labelled))


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
            if isinstance(statement, Rule) and statement.always is not None:
                if isinstance(before, Rule) and before.always == statement.always:
                    continue
            elif isinstance(statement, Rule):
                rules += 1
                labelled = statement.labelled or statement.label != f"rule_{rules}"
            heading, above = split_heading(_above(statement, labelled), bool(settings))
            if before is not None and (settings or _is_separate(before, statement)):
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
            yield with_comment(f"RULE {rule.label}", own.behind)
            yield from comment_lines(trimmed(first.above))
            comment = first.behind
        else:
            comment = first.behind if own.behind is None else own.behind
        lines = EnglishPrinter(self._with_comments)
        lines.begin(comment=comment)
        guard = lines.formulas.guard(rule.guard)
        lines.write("ALWAYS " if rule.always is not None else f"WHEN {rule.trigger}{guard} THEN ")
        lines.response(rule.default)
        lines.hedges(rule.hedges)
        yield from lines.take_lines()


def _other(statement: Statement) -> list[str]:
    """The lines of a statement that is not a rule, without the comments above it."""
    lines = EnglishPrinter()
    lines.begin(comment=statement.comments.behind)
    if isinstance(statement, Claim):
        lines.write(f"{statement.kind.upper()} {statement.label} ")
        lines.claim(statement)
    else:
        lines.write(_text(statement, lines))
    return lines.take_lines()


def _text(statement: Statement, lines: EnglishPrinter) -> str:
    assert not isinstance(statement, (Rule, Claim))
    if isinstance(statement, Declaration):
        agent = f" BY {statement.agent}" if statement.agent is not None else ""
        return f"{statement.kind.upper()} {', '.join(statement.names)}{agent}"
    if isinstance(statement, Measure):
        return f"MEASURE {statement.name}: {' < '.join(statement.values) or statement.kind}"
    if isinstance(statement, Constant):
        return f"CONSTANT {statement.name} = {statement.alias or print_number(statement.value)}"
    if isinstance(statement, Exclusive):
        return f"EXCLUSIVE {', '.join(statement.names)}"
    if isinstance(statement, Never):
        return _never(statement)
    if isinstance(statement, Assume):
        return f"ASSUME {print_formula(statement.formula)}"
    return f"RELATION {lines.relation(statement)}"


def _never(statement: Never) -> str:
    """A NEVER, with each of its exceptions after UNLESS."""
    text = f"NEVER {print_formula(statement.forbidden)}"
    if not isinstance(statement.formula, And):
        return text
    last = statement.formula.operands[len(statement.formula.operands) - statement.exceptions :]
    negated = (exception.operand for exception in last if isinstance(exception, Not))
    return " ".join([text, *(f"UNLESS {print_formula(condition)}" for condition in negated)])


def _is_separate(before: Statement, statement: Statement) -> bool:
    """Whether a blank line separates two statements: each rule, and each group of other statements of one kind."""
    return isinstance(statement, Rule) or _group(before) != _group(statement)


def _group(statement: Statement) -> str:
    if isinstance(statement, (Rule, Declaration, Measure, Constant, Exclusive, Never, Assume)):
        return type(statement).__name__
    # A concern or a purpose, or one of the relations.
    return getattr(statement, "kind", "relation")


def _above(statement: Statement, labelled: bool) -> Sequence[str]:
    """The comments above a statement. A rule without a label shares the line of its default: the comments of both are
    above it, also the second of two comments after it."""
    if not isinstance(statement, Rule) or labelled:
        return statement.comments.above
    own, default = statement.comments, statement.default.comments
    one_too_many = default.behind if own.behind is not None else None
    above = (*own.above, *default.above)
    return (*above, one_too_many) if one_too_many else above
