"""From values back to text in the DSL, in one canonical form: what is printed parses to the same ruleset.

A definition, rule, hedge, claim or relation a line, and an empty one between two statements where the author left some.
LEGOS's dialect has measures in braces and every operation in parentheses; SLEEC-TK's has as few parentheses as it can
be read with.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from sleec_runtime.errors import Unsayable
from sleec_runtime.language.common.formula_printer import print_number
from sleec_runtime.language.common.line_printer import behind, comment_lines, split_heading, trimmed, with_gaps
from sleec_runtime.language.common.token_cursor import MAX_DEPTH
from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Claim,
    Clause,
    Comparison,
    Constant,
    Declaration,
    Dialect,
    Effect,
    EventRelation,
    Formula,
    Lasting,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    Not,
    Number,
    Obligation,
    Or,
    Relation,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Term,
    Truth,
)

_INDENT = "    "
_SECOND = re.compile(r"#\d+$")


def print_dsl(ruleset: Ruleset) -> str:
    """`ruleset` as a text in the DSL, with its comments, ending in a line break (or empty).

    Raises:
        Unsayable: something in it cannot be said in the DSL.
    """
    return "".join(f"{line}\n" for line in _Printer(ruleset.dialect or "legos").ruleset(ruleset))


class _Printer:
    """Writes lines. The line at hand grows until a hedge, or whatever is next, begins a new one."""

    def __init__(self, dialect: Dialect) -> None:
        self._legos = dialect == "legos"
        self._done: list[str] = []
        self._line = ""
        self._remark: str | None = None

    def ruleset(self, ruleset: Ruleset) -> Iterator[str]:
        """The lines of a whole text."""
        block: str | None = None
        for statement in ruleset.statements:
            own = _block(statement)
            above: Sequence[str] = with_gaps(statement.comments.above)
            if own != block:
                heading, above = split_heading(statement.comments.above, True)
                if block is not None:
                    yield f"{block}_end"
                    yield ""
                yield from comment_lines(heading)
                yield f"{own}_start"
                block = own
            self._begin(_INDENT, "", above, statement.comments.behind)
            self._statement(statement)
            self._end()
            yield from self._done
            self._done.clear()
        if block is not None:
            yield f"{block}_end"
        closing = trimmed(ruleset.closing_comments)
        if closing:
            if block is not None:
                yield ""
            yield from comment_lines(closing)

    # Lines ----------------------------------------------------------------------------------------------------

    def _begin(self, indent: str, text: str, above: Sequence[str], remark: str | None) -> None:
        """A new line, with the comments above it, and the one behind."""
        self._end()
        self._done += [indent + line if line else line for line in comment_lines(above)]
        self._line = indent + text
        self._remark = remark

    def _end(self) -> None:
        if self._line:
            self._done.append(behind(self._line, self._remark))
        self._line = ""

    # Statements -----------------------------------------------------------------------------------------------

    def _statement(self, statement: Statement) -> None:
        if isinstance(statement, Rule):
            self._rule(statement)
        elif isinstance(statement, Claim):
            self._line += f"{_label(statement.label)} "
            self._claim(statement)
        elif isinstance(statement, (Declaration, Measure, Constant)):
            self._line += self._definition(statement)
        elif isinstance(statement, (EventRelation, MeasureRelation, Effect, Lasting)):
            self._line += self._relation(statement)

    def _definition(self, statement: Declaration | Measure | Constant) -> str:
        if isinstance(statement, Constant):
            alias = statement.alias and ("-> " if self._legos else "") + statement.alias
            return f"constant {statement.name} = {alias or print_number(statement.value)}"
        if isinstance(statement, Measure):
            scale = f"scale({', '.join(statement.values)})" if statement.kind == "scale" else "numeric"
            return f"measure {statement.name}: {scale}"
        (name,) = statement.names
        if statement.kind == "condition":
            return f"measure {name}: boolean"
        return f"event {name} as {statement.agent}" if statement.agent else f"event {name}"

    def _rule(self, rule: Rule) -> None:
        self._line += f"{_label(rule.label)} when {rule.trigger}{self._guard(rule.guard)} then "
        self._response(rule.default, _INDENT)
        for hedge in rule.hedges:
            self._hedge(hedge, _INDENT * 2)

    def _guard(self, guard: Formula | None) -> str:
        return "" if guard is None else f" and {self.formula(guard)}"

    def _claim(self, claim: Claim) -> None:
        self._line += f"{claim.form} {claim.event}{self._guard(claim.condition)}"
        word = "while" if claim.form == "exists" else "then"
        for clause in claim.responses:
            self._line += f" {word} "
            self._obligation(clause, _INDENT)
            for hedge in clause.hedges:
                self._hedge(hedge, _INDENT * 2)
            word = "while"
        if claim.meanwhile is not None:
            self._line += " meanwhile ("
            self._claim(claim.meanwhile)
            self._line += ")"

    def _relation(self, relation: Relation) -> str:
        if isinstance(relation, EventRelation):
            return f"{relation.relation} {relation.left} {relation.right}"
        if isinstance(relation, Effect):
            return f"{relation.relation} {relation.event} {self.formula(relation.formula)}"
        if isinstance(relation, MeasureRelation):
            right = "" if relation.right is None else f" {self.formula(relation.right)}"
            return f"measure {relation.relation} {self.formula(relation.left)}{right}"
        line = f"when {relation.event}{self._guard(relation.condition)} then {self.formula(relation.formula)}"
        if relation.duration is not None:
            return f"{line} for {self._length(relation.duration)}"
        return f"{line} until {relation.end}{self._guard(relation.end_condition)}"

    # Responses ------------------------------------------------------------------------------------------------

    def _hedge(self, hedge: Clause, indent: str) -> None:
        assert hedge.condition is not None, "a hedge has a condition"
        comments = hedge.comments
        self._begin(indent, f"unless {self.formula(hedge.condition)}", trimmed(comments.above), comments.behind)
        if hedge.obligations or hedge.hedges:
            self._line += " then "
            self._response(hedge, indent)

    def _response(self, clause: Clause, indent: str, in_braces: bool = False) -> None:
        """A response, in braces where it has hedges of its own."""
        if not clause.hedges and not in_braces:
            self._obligation(clause, indent)
            return
        self._line += "{"
        self._obligation(clause, indent)
        for hedge in clause.hedges:
            self._hedge(hedge, indent + _INDENT)
        self._line += "}"

    def _obligation(self, clause: Clause, indent: str) -> None:
        if len(clause.obligations) != 1:
            raise Unsayable(
                f"a response of the DSL is one event, and here {_said(clause.obligations)}",
                "write a rule for each event",
            )
        (obligation,) = clause.obligations
        self._line += f"{'not ' if obligation.negated else ''}{obligation.name}"
        timing = obligation.timing
        if timing is None:
            return
        window = timing.window
        if window is not None:
            if window.end is None:
                self._line += " eventually"
            elif window.start is None:
                self._line += f" within {self._length(window.end)}"
            else:
                self._line += f" within [{self._length(window.start)}, {self._length(window.end)}]"
        if timing.otherwise is not None:
            # Without braces an `else` would belong to the nearest response before it.
            self._line += " otherwise "
            self._response(timing.otherwise, indent, in_braces=timing.instead is not None)
        if timing.instead is not None:
            self._line += " else "
            self._response(timing.instead, indent)

    def _length(self, length: Length) -> str:
        return f"{self._term(length.amount)} {length.unit}"

    # Formulas -------------------------------------------------------------------------------------------------

    def formula(self, formula: Formula) -> str:
        if isinstance(formula, Truth):
            return "true" if formula.value else "false"
        if isinstance(formula, Atom):
            return formula.name if formula.kind == "trigger" else self._measure(formula.name)
        if isinstance(formula, Comparison):
            operator = "<>" if formula.operator == "!=" else formula.operator
            text = f"{self._term(formula.left)} {operator} {self._term(formula.right)}"
        elif isinstance(formula, Not):
            text = f"not {self._operand(formula.operand, (Not, And, Or))}"
        else:
            text = self._joined(formula)
        return f"({text})" if self._legos else text

    def _joined(self, formula: And | Or) -> str:
        word = " and " if isinstance(formula, And) else " or "
        operands = [self._operand(operand, (And, Or)) for operand in formula.operands]
        if not self._legos or len(operands) > MAX_DEPTH // 2:
            return word.join(operands)
        # Two operands at a time: a and (b and c).
        return word.join(f"{'(' if n else ''}{text}" for n, text in enumerate(operands[:-1])) + (
            word + operands[-1] + ")" * (len(operands) - 2)
        )

    def _operand(self, formula: Formula, in_parentheses: tuple[type, ...]) -> str:
        text = self.formula(formula)
        return f"({text})" if isinstance(formula, in_parentheses) and not self._legos else text

    def _measure(self, name: str) -> str:
        return f"{{{name}}}" if self._legos else name

    def _term(self, term: Term) -> str:
        if isinstance(term, MeasureRef):
            return self._measure(term.name)
        if isinstance(term, ScaleValue):
            return term.value
        if isinstance(term, Calculation):
            return term.written(self._measure, "({})".format if self._legos else str)
        return _number(term)


def _number(number: Number) -> str:
    return number.constant if number.constant is not None else print_number(number.value)


def _label(label: str) -> str:
    """A label as it is written: the second of two rules with one label is told apart by its number only here."""
    return _SECOND.sub("", label)


def _said(obligations: tuple[Obligation, ...]) -> str:
    return f"there are {len(obligations)}: {', '.join(map(str, obligations))}" if obligations else "there is none"


def _block(statement: Statement) -> str:
    if isinstance(statement, Rule):
        return "rule"
    if isinstance(statement, Claim):
        return statement.kind
    if isinstance(statement, (EventRelation, MeasureRelation, Effect, Lasting)):
        return "relation"
    if isinstance(statement, Constant):
        return "def"
    if isinstance(statement, Measure) or (isinstance(statement, Declaration) and len(statement.names) == 1):
        return "def"
    raise Unsayable(f"the DSL has no word for {type(statement).__name__.upper()}")
