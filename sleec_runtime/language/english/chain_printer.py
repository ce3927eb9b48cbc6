"""Responses and chains of hedges back to text: a line a hedge, and parentheses only where they are needed.

Several obligations behind IN WHICH CASE have them too, because people read those more easily.
"""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.language.common.formula_printer import print_formula, print_term
from sleec_runtime.language.common.line_printer import behind, comment_lines, trimmed
from sleec_runtime.language.english.responses import is_choice
from sleec_runtime.model import Clause, Comments, Length, Number, Obligation, Window

_INDENT = "    "


class ChainPrinter:
    """Writes lines. The one at hand grows until a hedge begins the next."""

    def __init__(self, comments: bool = True) -> None:
        self._with_comments = comments
        self._done: list[str] = []
        self._line = ""
        self._remark: str | None = None

    def begin(self, indent: str, comments: Comments) -> None:
        """A new line, with the comments above it."""
        self._end()
        if self._with_comments:
            self._done += [indent + line if line else line for line in comment_lines(trimmed(comments.above))]
            self._remark = comments.behind
        self._line = indent

    def write(self, text: str) -> None:
        """More of the line at hand."""
        self._line += text

    def lines(self) -> list[str]:
        """All that was written."""
        self._end()
        return self._done

    def _end(self) -> None:
        if self._line:
            self._done.append(behind(self._line, self._remark))
        self._line = ""

    # Chains ---------------------------------------------------------------------------------------------------

    def hedges(self, hedges: Sequence[Clause], indent: str = "") -> None:
        """A chain, a line a hedge."""
        for hedge in hedges:
            assert hedge.condition is not None, "a hedge has a condition"
            self.begin(indent, hedge.comments)
            self.write(f"UNLESS {print_formula(hedge.condition)}")
            if hedge.obligations or hedge.hedges:
                self.write(" IN WHICH CASE ")
                self.response(hedge, indent, of_hedge=True)

    def response(self, clause: Clause, indent: str = "", of_hedge: bool = False) -> None:
        """The obligations of a clause, and the chain nested in it."""
        *first, last = clause.obligations or (None,)
        grouped = bool(clause.hedges) or (of_hedge and bool(first) and not any(map(_has_alternatives, first)))
        if grouped:
            self.write("(")
        for obligation in first:
            self._in_list(obligation, indent, _has_alternatives(obligation))
            self.write(" AND ")
        if last is not None:
            self._in_list(last, indent, of_hedge and not grouped and is_choice(last))
        self.hedges(clause.hedges, indent + _INDENT)
        if grouped:
            self.write(")")

    def _in_list(self, obligation: Obligation, indent: str, in_parentheses: bool) -> None:
        if in_parentheses:
            self.write("(")
        self._obligation(obligation, indent)
        if in_parentheses:
            self.write(")")

    def _obligation(self, obligation: Obligation, indent: str) -> None:
        self.write(str(obligation))
        timing = obligation.timing
        if timing is None:
            return
        if timing.window is not None:
            self.write(f" {window_text(timing.window)}")
        if timing.otherwise is not None:
            self.write(" OTHERWISE ")
            # Without parentheses an ELSE would belong to the nearest obligation before it.
            self._alternative(timing.otherwise, indent, timing.instead is not None)
        if timing.instead is not None:
            self.write(" ELSE ")
            self._alternative(timing.instead, indent, False)

    def _alternative(self, clause: Clause, indent: str, in_parentheses: bool) -> None:
        in_parentheses = in_parentheses or len(clause.obligations) > 1
        if in_parentheses and not clause.hedges:
            self.write("(")
        self.response(clause, indent)
        if in_parentheses and not clause.hedges:
            self.write(")")


def _has_alternatives(obligation: Obligation) -> bool:
    return obligation.timing is not None and any(True for _ in obligation.timing.alternatives())


def window_text(window: Window) -> str:
    """A window as it stands behind an obligation."""
    if window.end is None:
        return "EVENTUALLY"
    if window.start is None:
        return f"WITHIN {length_text(window.end)}"
    same = window.start.unit == window.end.unit
    start = print_term(window.start.amount) if same else length_text(window.start)
    return f"WITHIN {start} TO {length_text(window.end)}"


def length_text(length: Length) -> str:
    """A length of time, with the unit in the singular where the number is one."""
    unit = length.unit[:-1] if length.amount == Number(1) else length.unit
    return f"{print_term(length.amount)} {unit}"
