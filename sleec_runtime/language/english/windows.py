"""Times of obligations: ``WITHIN 5 minutes``, ``WITHIN 1 TO 5 minutes`` (or ``[1, 5] minutes``), ``EVENTUALLY``."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.language.common.comparisons import MAX_DIGITS
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import MAX_NAME
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.common.window_parser import WindowParser
from sleec_runtime.language.english.declarations import EnglishDeclarationParser
from sleec_runtime.language.english.keywords import ALTERNATIVES, PHRASE, TIMES
from sleec_runtime.model import Length, MeasureRef, Number, Span, Unit, Window

_EXAMPLE = "for example: WITHIN 5 minutes"
_TO = "TO"


class _Bound(NamedTuple):
    """One end of a window as it is written; without a unit if only the other end has one."""

    amount: Number | MeasureRef
    unit: Unit | None
    span: Span


class EnglishTimeParser(EnglishDeclarationParser, WindowParser):
    """Reads windows and lengths of time."""

    window_example = "WITHIN 5 minutes"
    range_example = "WITHIN 1 TO 5 minutes"

    def window(self) -> Window | None:
        """The window at hand; None if there is none."""
        first = self.at
        kind = self.kinds[first]
        if kind not in TIMES:
            return None

        self.at += 1
        if kind == "EVENTUALLY":
            window = Window(None, None, self.span(first))
        else:
            start, end = self._ends()
            window = Window(end, start, self.span(first))
            self.check_window(window)
        behind = self._lower_case(self.at)
        if behind in ALTERNATIVES:
            self.correct_keyword(self.at, behind)
        if self.kinds[self.at] in TIMES:
            self.expected("the end of the obligation", "an obligation has one time; delete the other")
        return window

    def length(self) -> Length:
        """``5 minutes``; the number may be a constant or a measure."""

        bound = self._bound()
        length = Length(bound.amount, bound.unit or self.unit(), bound.span)
        self.check_length(length)
        return length

    def _ends(self) -> tuple[Length | None, Length]:

        if self.token_text(self.at) == "[":
            start, end = self._in_brackets()
            unit = self.unit() if start.unit is None or end.unit is None else None
        else:
            start = self._bound()
            if not self._is_to():
                return None, Length(start.amount, start.unit or self.unit(), start.span)
            self.at += 1
            end = self._bound()
            unit = end.unit or self.unit()
        # A unit after both is that of each end without a unit.
        return (
            Length(start.amount, start.unit or unit or "seconds", start.span),
            Length(end.amount, end.unit or unit or "seconds", end.span),
        )

    def _in_brackets(self) -> tuple[_Bound, _Bound]:
        opened = self.at
        self.at += 1
        start = self._bound(in_brackets=True)
        if self.kinds[self.at] != ",":
            self.expected("a comma between the two ends of the window", "for example: WITHIN [1, 5] minutes")
        self.at += 1
        end = self._bound(in_brackets=True)
        self.close("]", opened)
        return start, end

    # Amounts and units ----------------------------------------------------------------------------------------

    def _bound(self, in_brackets: bool = False) -> _Bound:
        """An amount, with its unit if that follows directly."""
        first = self.at
        kind = self.kinds[first]
        if kind == "number":
            amount: Number | MeasureRef = Number(self._whole_number(in_brackets))
        elif kind == "word" and not self._is_to():
            amount = self._named_amount()
        elif kind == "digits":
            self.fail(
                f"{quoted(self.token_text(first))} is not a number",
                self.token_span(first),
                "write a whole number, a space and a unit: 5 minutes",
            )
        else:
            self.expected("a length of time, such as 5 minutes", _EXAMPLE)
        unit = self.unit_at_hand()
        return _Bound(amount, unit, self.span(first))

    def _whole_number(self, in_brackets: bool) -> int:
        token = self.at
        span = self.token_span(token)
        text = self.token_text(token)
        # In brackets a comma separates two numbers; elsewhere it may be a decimal comma.
        if in_brackets:
            self.at += 1
        else:
            self.number()
        if text.startswith("-"):
            self.fail(f"a time cannot be negative: {text[:20]}", span, "times count from the trigger onwards")
        if "." in text:
            self.fail(f"{quoted(text)} is not a whole number", span, "use a smaller unit: 90 seconds, not 1.5 minutes")
        if len(text) > MAX_DIGITS:
            self.fail(f"this number has more than {MAX_DIGITS} digits", span, "is a space missing?")
        return int(text)

    def _named_amount(self) -> Number | MeasureRef:
        """The constant or measure at hand; its name may be a phrase, which a unit ends."""
        first = self.at
        end = first + 1
        while self.kinds[end] in PHRASE and self.ends[end] < self.starts[first] + MAX_NAME:
            if self._ends_amount(end, first):
                break
            end += 1
        known = [at for at in range(first + 1, end + 1) if self.names.has_amount(self.joined_name(first, at))]
        if known:
            end = known[-1]
        elif self.token_text(end - 1) in UNITS:
            end -= 1
        if end == first:
            self.expected("a number before the unit", _EXAMPLE)
        name = self.joined_name(first, end)
        span = Span(self.starts[first], self.ends[end - 1])
        self.at = end
        found = None if self.has_failed else self.names.amount(name, span)
        if found is None:
            # The problem is reported; the rest can still be read.
            self.has_failed = True
            return Number(0, name)
        return found

    def _ends_amount(self, token: int, first: int) -> bool:
        """Whether the phrase that names an amount ends before this word of it."""
        if self.token_text(token) == _TO:
            return True
        keyword = self.keyword_meant(token, self.token_text(token), first) or self._lower_case(token)
        if keyword is not None:
            self.correct_keyword(token, keyword)
        return keyword is not None

    def _lower_case(self, token: int) -> str | None:
        word = self.token_text(token) if self.kinds[token] == "word" else ""
        return word.upper() if word in ("otherwise", "else", "and", "or") else None

    def _is_to(self) -> bool:
        return self.kinds[self.at] == "word" and self.token_text(self.at) == _TO
