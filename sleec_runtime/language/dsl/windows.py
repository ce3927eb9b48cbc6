"""Times of responses: ``within 5 minutes``, ``within [1, 5] minutes``, ``eventually``."""

from __future__ import annotations

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ClauseError
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.common.window_parser import WindowParser
from sleec_runtime.language.dsl.definitions import DslDefinitionParser
from sleec_runtime.language.dsl.keywords import ITEM_STARTS
from sleec_runtime.model import NOWHERE, Length, Number, Span, Unit, Window

_EXAMPLE = "for example: within 5 minutes"
_RANGE_EXAMPLE = "for example: within [1, 5] minutes"


class DslTimeParser(DslDefinitionParser, WindowParser):
    """Reads windows and lengths of time."""

    window_example = "within 5 minutes"
    range_example = "within [1, 5] minutes"

    def window(self) -> Window | None:
        """The window at hand; None if there is none."""
        first = self.at
        if self.kinds[first] not in ("within", "eventually"):
            return None

        self.at += 1
        if self.kinds[first] == "eventually":
            return Window(None, None, self.span(first))
        start: Length | None = None
        if self.kinds[self.at] == "[":
            start, end = self._ends(first)
        else:
            end = self.length()
        if self.kinds[self.at] == "eventually":
            self.expected("the end of the response", "a response has one time: delete eventually or the window")
        window = Window(end, start, self.span(first))
        if not self.has_failed:
            self.check_window(window)
        return window

    def length(self, may_lack_unit: bool = False) -> Length:
        """``5 minutes``; the number may be a constant or a measure. In brackets the unit may follow them instead."""

        first = self.at
        self._refuse_no_length()
        side = self.calculation("a length of time, such as 5 minutes")
        amount = None if self.has_failed else self.names.amount(side)
        if isinstance(side, Side) and isinstance(side.written, int) and side.written < 0:
            self.fail(f"a time cannot be negative: {side.written}", side.span, "times count from the trigger onwards")
        if amount is None:
            raise ClauseError
        if may_lack_unit and self.kinds[self.at] in (",", "]"):
            unit: Unit = "seconds"
            span = NOWHERE
        else:
            unit, span = self.unit(), self.span(first)
        if isinstance(amount, Number) and amount.value < 0:
            written = quoted(self.text[side.span.start : side.span.end])
            self.fail(f"a time cannot be negative: {written} is {amount.value}", side.span, "use another value")
        length = Length(amount, unit, span)
        self.check_length(length)
        return length

    def unit_hint(self, word: str) -> str:
        if word in ("to", "and", "or"):
            return f"write a window with two ends in brackets, {_RANGE_EXAMPLE}"
        return super().unit_hint(word)

    def _refuse_no_length(self) -> None:
        at, what = self.at, "a length of time, such as 5 minutes"
        if self.kinds[at] == "[" or (self.token_text(at) in UNITS and self.kinds[at + 1] != "word"):
            self.expected("a number before the unit", _EXAMPLE)
        if self.kinds[at] == "digits":
            self.expected(what, f"write a space between the number and the unit, {_EXAMPLE}")
        if self.kinds[at] == "(" and self.kinds[at + 2] == ",":
            self.expected(what, f"write a window with two ends in brackets, {_RANGE_EXAMPLE}")
        if self.kinds[at] in ITEM_STARTS:
            self.expected(what, _EXAMPLE)

    def _ends(self, first: int) -> tuple[Length, Length]:
        """``[a, b] UNIT``: the unit after the brackets is that of each end without a unit of its own."""

        opened = self.at
        self.at += 1
        start = self.length(may_lack_unit=True)
        self.require(",", "a comma between the two ends of the window", _RANGE_EXAMPLE)
        end = self.length(may_lack_unit=True)
        self.close("]", opened)
        if NOWHERE not in (start.span, end.span):
            return start, end
        span: Span
        if self.kinds[self.at] != "word" and start.span is NOWHERE and end.span is not NOWHERE:
            unit, span = end.unit, end.span
        else:
            unit, span = self.unit(), self.span(first)
        return (
            Length(start.amount, unit, span) if start.span is NOWHERE else start,
            Length(end.amount, unit, span) if end.span is NOWHERE else end,
        )
