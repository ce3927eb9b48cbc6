"""Responses: ``[not] Event [within … | eventually] [otherwise …] [else …]``, and chains of hedges.

What follows `otherwise`, `else` and the `then` of a hedge has hedges of its own only inside braces: an `unless` without
them belongs to the rule.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ALTERNATIVE_LEVELS, Abandon
from sleec_runtime.language.common.units import UNITS, unit_meant
from sleec_runtime.language.dsl.definitions import DefinitionParser
from sleec_runtime.language.dsl.keywords import ITEM_STARTS
from sleec_runtime.language.dsl.slips import before_event, number_for, unit_for
from sleec_runtime.model import NO_COMMENTS, NOWHERE, Clause, Formula, Number, Obligation, Span

if TYPE_CHECKING:
    from sleec_runtime.model import Length, Timing, Unit, Window


class ResponseParser(DefinitionParser):
    """Reads responses."""

    def chain(self, condition: Formula | None, first: int) -> Clause:
        """A response as a clause that begins with token `first`: one event, or a chain in braces."""
        comments = NO_COMMENTS if condition is None else self.comments_of(first)
        if self.kinds[self.at] != "{":
            obligation = self._occurrence()
            return Clause(condition, (obligation,), (), self.span(first), comments)
        opened = self.at
        self.deeper()
        self.at += 1
        obligation = self._occurrence()
        hedges: list[Clause] = []
        while self.kinds[self.at] == "unless":
            hedges.append(self.hedge())
        self.close("}", opened)
        self.depth -= 1
        return Clause(condition, (obligation,), tuple(hedges), self.span(first), comments)

    def hedge(self) -> Clause:
        """``unless condition [then response]``."""
        first = self.at
        self.at += 1
        condition = self.formula()
        if self.kinds[self.at] != "then":
            return Clause(condition, (), (), self.span(first), self.comments_of(first))
        self.at += 1
        return self.chain(condition, first)

    def hedges(self, found: list[Clause], what: str) -> None:
        """The hedges at hand; a problem in one leaves the others readable."""
        while self.kinds[self.at] == "unless":
            self.begin_clause()
            try:
                found.append(self.hedge())
                if self.kinds[self.at] != "unless":
                    self.end_of(what if found[-1].obligations else "and, or or then")
            except Abandon:
                self.recover()

    def recover(self) -> None:
        raise NotImplementedError

    def _occurrence(self) -> Obligation:
        first = self.at
        negated = self.accept("not")
        if negated and self.kinds[self.at] == "not":
            self.expected("the name of an event", "not stands before one event, once")
        at_name = self.at
        if self.kinds[at_name] == "{":
            self.expected("the name of an event", "a response is an event; braces hold a measure or a whole chain")
        name = self.name("the name of an event", self._hint_at_response())
        self._refuse_word_before_event(at_name)
        if not self.hurt:
            self.names.event(name, self.token_span(at_name), "a response")
        kind = self.kinds[self.at]
        if kind in ("and", "or"):
            self.fail(
                f"a response is one event, so {kind} cannot follow it",
                self.token_span(self.at),
                "write a rule for each event" if kind == "and" else "write else between the two",
            )
        window = self._window()
        alternatives: dict[str, Clause] = {}
        for word in ("otherwise", "else"):
            if self.accept(word):
                self.deeper(ALTERNATIVE_LEVELS)
                alternatives[word] = self.chain(None, self.at)
                self.depth -= ALTERNATIVE_LEVELS
        if self.kinds[self.at] == "otherwise":
            self.expected("the end of the response", "a response has one otherwise; put the second into braces")
        return Obligation(name, negated, self.span(first), self._timing(window, alternatives))

    def _hint_at_response(self) -> str | None:
        kind = self.kinds[self.at]
        if kind in ("within", "eventually"):
            return f"first comes the event: Response {kind}{' 5 minutes' if kind == 'within' else ''}"
        return "say what is to be done, as in: then Response" if kind in ITEM_STARTS | {"unless", "otherwise"} else None

    def _refuse_word_before_event(self, at_name: int) -> None:
        """Gives up where `at_name`, which was read as the name of an event, is a word before one."""
        word = self.token_text(at_name)
        if word in self.names.kinds or self.kinds[self.at] not in ("word", "strange"):
            return
        hint = "write not in small letters" if word.lower() == "not" else before_event(word)
        if hint is not None:
            self.fail(f"expected the name of an event, but found {quoted(word)}", self.token_span(at_name), hint)

    def _timing(self, window: Window | None, alternatives: dict[str, Clause]) -> Timing | None:
        if window is None and not alternatives:
            return None
        from sleec_runtime.model import Timing

        return Timing(window, alternatives.get("otherwise"), alternatives.get("else"))

    # Windows --------------------------------------------------------------------------------------------------

    def _window(self) -> Window | None:
        first = self.at
        if self.kinds[first] not in ("within", "eventually"):
            return None
        from sleec_runtime.model import Window

        self.at += 1
        if self.kinds[first] == "eventually":
            return Window(None, None, self.span(first))
        start: Length | None = None
        if self.kinds[self.at] == "[":
            opened = self.at
            self.at += 1
            start = self.length(may_lack_unit=True)
            self.require(",", "a comma between the two ends of the window", "as in: within [1, 5] minutes")
            end = self.length(may_lack_unit=True)
            self.close("]", opened)
            start, end = self._same_unit(start, end, first)
        else:
            end = self.length()
        if self.kinds[self.at] == "eventually":
            self.expected("the end of the response", "a response has a window, or is due eventually: delete one")
        span = self.span(first)
        if start is not None and not self.hurt:
            begins, ends = start.seconds, end.seconds
            if begins is not None and ends is not None and begins > ends:
                self.problem(
                    f"this window ends, after {end}, before it begins, after {start}",
                    span,
                    "write the earlier end first, as in: within [1, 5] minutes",
                )
        return Window(end, start, span)

    def length(self, may_lack_unit: bool = False) -> Length:
        """``5 minutes``; the number may be a constant or a measure. In brackets the unit may stand behind them."""
        from sleec_runtime.model import Length

        first = self.at
        if self.kinds[first] == "[" or (self.token_text(first) in UNITS and self.kinds[first + 1] != "word"):
            self.expected("a number before the unit", "as in: within 5 minutes")
        self._refuse_plain_numbers()
        side = self.operand("a length of time, such as 5 minutes")
        amount = None if self.hurt else self.names.amount(side)
        if isinstance(side, Side) and isinstance(side.written, int) and side.written < 0:
            self.fail(
                f"a window cannot be negative: {side.written}",
                side.span,
                "times count from the trigger; nothing is due before it",
            )
        if amount is None:
            raise Abandon
        if may_lack_unit and self.kinds[self.at] in (",", "]"):
            unit: Unit = "seconds"
            span = NOWHERE
        else:
            unit, span = self._unit(), self.span(first)
        if isinstance(amount, Number) and amount.value < 0:
            self.fail(
                f"a window cannot be negative: {quoted(self.text[side.span.start : side.span.end])} is",
                side.span,
                "give it another value",
            )
        return Length(amount, unit, span)

    def _refuse_plain_numbers(self) -> None:
        """Gives up where a number is written as a word, or a window with two ends has no brackets."""
        at, what = self.at, "a length of time, such as 5 minutes"
        word = self.token_text(at)
        hint = number_for(word, self.token_text(at + 1)) if word not in self.names.kinds else None
        if hint is not None:
            self.expected(what, hint)
        if self.kinds[at] == "(" and self.kinds[at + 2] == ",":
            self.expected(what, "a window with two ends has brackets, as in: within [1, 5] minutes")
        if self.kinds[at] in ITEM_STARTS:
            self.expected(what, "as in: within 5 minutes")

    def _unit(self) -> Unit:
        if self.kinds[self.at] != "word" or self.token_text(self.at) not in UNITS:
            written = self.token_text(self.at)
            if self.kinds[self.at] == "number":
                self.expected("a comma or a unit after the number", "as in: within [1, 5] minutes")
            if self.kinds[self.at] != "word":
                self.expected("a unit after the number: seconds, minutes, hours or days", "as in: within 5 minutes")
            if "\n" in self.text[self.ends[self.at - 1] : self.starts[self.at]]:
                end = self.ends[self.at - 1]
                self.fail("a unit is missing after the number", Span(end, end), "as in: within 5 minutes")
            near = unit_meant(written)
            self.fail(
                f"there is no unit {quoted(written)}",
                self.token_span(self.at),
                unit_for(written)
                or (f"did you mean {near}?" if near else "the units are seconds, minutes, hours and days"),
            )
        unit = self.token_text(self.at)
        self.at += 1
        return cast("Unit", unit if unit.endswith("s") else f"{unit}s")

    def _same_unit(self, start: Length, end: Length, first: int) -> tuple[Length, Length]:
        """``[a, b] UNIT``: the unit behind the brackets is that of both ends, which then have none of their own."""
        from sleec_runtime.model import Length

        bare = [length for length in (start, end) if length.span is NOWHERE]
        if not bare:
            return start, end
        if self.kinds[self.at] == "word":
            unit = self._unit()
            span: Span = self.span(first)
        elif start.span is NOWHERE and end.span is not NOWHERE:
            unit, span = end.unit, end.span
        else:
            self.expected("a unit: seconds, minutes, hours or days", "as in: within [1, 5] minutes")
        return tuple(Length(o.amount, unit, span) if o.span is NOWHERE else o for o in (start, end))  # type: ignore[return-value]
