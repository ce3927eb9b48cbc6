"""From values back to text, in one canonical form: what is printed parses to the same ruleset, and prints the same.

One clause a line, a blank line between rules, and parentheses only where they are needed, except around a response of
several obligations behind IN WHICH CASE and a guard with OR, which people read more easily with them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import (
    NO_COMMENTS,
    And,
    Assume,
    Atom,
    Clause,
    Comments,
    Comparison,
    Constant,
    Declaration,
    Exclusive,
    Formula,
    Measure,
    MeasureRef,
    Never,
    Not,
    Or,
    Rational,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Term,
)

_INDENT = "    "


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


def print_formula(formula: Formula) -> str:
    """A formula as text, with as few parentheses as it can be read with."""
    if isinstance(formula, Atom):
        return formula.name
    if isinstance(formula, Or):
        # AND binds tighter than OR and needs no parentheses in it; an OR in an OR was written with them.
        return " OR ".join(_operand(operand, Or) for operand in formula.operands)
    if isinstance(formula, And):
        return " AND ".join(_operand(operand, (And, Or)) for operand in formula.operands)
    if isinstance(formula, Not):
        return f"NOT {_operand(formula.operand, (And, Or))}"
    if isinstance(formula, Comparison):
        return f"{print_term(formula.left)} {formula.operator} {print_term(formula.right)}"
    return "true" if formula.value else "false"


def print_term(term: Term) -> str:
    """One side of a comparison; a number that was written by the name of a constant keeps that name."""
    if isinstance(term, MeasureRef):
        return term.name
    if isinstance(term, ScaleValue):
        return term.value
    return term.constant if term.constant is not None else print_number(term.value)


def print_number(value: Rational) -> str:
    """A number exactly: as a decimal if it has one that ends, as every number of a text does, else as a fraction."""
    if value.denominator == 1:
        return str(int(value))
    digits, rest = 0, value.denominator
    for prime in (2, 5):
        power = 0
        while rest % prime == 0:
            rest //= prime
            power += 1
        digits = max(digits, power)
    if rest != 1:
        return str(value)
    scaled = str(abs(int(value * 10**digits))).rjust(digits + 1, "0")
    return f"{'-' if value < 0 else ''}{scaled[:-digits]}.{scaled[-digits:]}"


def _operand(formula: Formula, in_parentheses: type | tuple[type, ...]) -> str:
    text = print_formula(formula)
    return f"({text})" if isinstance(formula, in_parentheses) else text


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
            if isinstance(statement, Rule):
                yield from self.rule(statement, labelled)
            else:
                yield behind(_statement(statement), statement.comments.behind)
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
        guard = ""
        if rule.guard is not None:
            guard = f" AND {_operand(rule.guard, Or)}"
        when = f"WHEN {rule.trigger}{guard} THEN "
        yield from self._clause(when, rule.default, Comments(behind=remark), "", in_parentheses=False)
        for hedge in rule.hedges:
            yield from self._hedge(hedge, "", "")

    def _hedge(self, hedge: Clause, indent: str, closing: str) -> Iterator[str]:
        assert hedge.condition is not None
        comments = hedge.comments if self._with_comments else NO_COMMENTS
        for line in comment_lines(trimmed(comments.above)):
            yield indent + line if line else line
        unless = f"{indent}UNLESS {print_formula(hedge.condition)}"
        if hedge.obligations or hedge.hedges:
            yield from self._clause(f"{unless} IN WHICH CASE ", hedge, comments, closing, in_parentheses=True)
        else:
            yield behind(unless + closing, comments.behind)

    def _clause(
        self, line: str, clause: Clause, comments: Comments, closing: str, in_parentheses: bool
    ) -> Iterator[str]:
        """The line of a clause, which `line` begins, and those of the chain that is nested in it."""
        for obligation in clause.obligations:
            if obligation.timing is not None:
                raise Unsayable(f"structured English has no words yet for times, as of {obligation.name}")
        response = " AND ".join(str(obligation) for obligation in clause.obligations)
        if not clause.hedges:
            if in_parentheses and len(clause.obligations) > 1:
                response = f"({response})"
            yield behind(line + response + closing, comments.behind)
            return
        indent = line[: len(line) - len(line.lstrip())] + _INDENT
        yield behind(f"{line}({response}", comments.behind)
        for nested in clause.hedges[:-1]:
            yield from self._hedge(nested, indent, "")
        yield from self._hedge(clause.hedges[-1], indent, f"){closing}")


def _statement(statement: Statement) -> str:
    if isinstance(statement, Declaration) and statement.kind != "event":
        return f"{statement.kind.upper()} {', '.join(statement.names)}"
    if isinstance(statement, Measure):
        return f"MEASURE {statement.name}: {' < '.join(statement.values) or statement.kind}"
    if isinstance(statement, Constant):
        return f"CONSTANT {statement.name} = {statement.alias or print_number(statement.value)}"
    if isinstance(statement, Exclusive):
        return f"EXCLUSIVE {', '.join(statement.names)}"
    if not isinstance(statement, (Never, Assume)):
        raise Unsayable("structured English has no words yet for events, concerns, purposes and relations")
    return f"{'NEVER' if isinstance(statement, Never) else 'ASSUME'} {print_formula(statement.formula)}"


def _stands_apart(before: Statement, statement: Statement) -> bool:
    """Whether a blank line separates two statements: rules stand alone, others in groups of one kind."""
    return isinstance(statement, Rule) or type(before) is not type(statement)


# Comments -------------------------------------------------------------------------------------------------


def _above(statement: Statement, labelled: bool) -> Sequence[str]:
    """The comments above a statement. A rule without a label has no line apart from its default's: the comments of both
    stand above it, and the one too many behind it, too."""
    if not isinstance(statement, Rule) or labelled:
        return statement.comments.above
    own, default = statement.comments, statement.default.comments
    one_too_many = default.behind if own.behind is not None else None
    above = (*own.above, *default.above)
    return (*above, one_too_many) if one_too_many else above


def split_heading(above: Sequence[str], has_settings: bool) -> tuple[Sequence[str], Sequence[str]]:
    """The comments above a statement: those above the DOMAIN or READING line before it, and those below that.

    An empty string is an empty line; the last one divides the two.
    """
    above = _without_leading(above)
    if not has_settings or "" not in above:
        return (), above
    gap = len(above) - 1 - above[::-1].index("")
    return above[:gap], above[gap + 1 :]


def _without_leading(comments: Sequence[str]) -> list[str]:
    found: list[str] = []
    for comment in comments:
        text = " ".join(comment.splitlines()).strip()
        if text or (found and found[-1]):
            found.append(text)
    return found


def trimmed(comments: Sequence[str]) -> list[str]:
    """Comments without empty ones at the beginning and at the end."""
    found = _without_leading(comments)
    return found[:-1] if found and not found[-1] else found


def comment_lines(comments: Sequence[str]) -> Iterator[str]:
    """Comments as lines; an empty one is an empty line."""
    for comment in comments:
        yield _comment(comment) if comment else ""


def _comment(text: str) -> str:
    return f"// {text}".rstrip()


def behind(line: str, comment: str | None) -> str:
    """A line with the comment behind it, if there is one."""
    if comment is None:
        return line
    return f"{line}  {_comment(' '.join(comment.splitlines()).strip())}"
