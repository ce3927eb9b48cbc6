"""Windows: what both languages read and check alike."""

from __future__ import annotations

from typing import ClassVar, NoReturn, cast

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import TokenCursor
from sleec_runtime.language.common.units import UNITS, unit_hint
from sleec_runtime.model import LONGEST, Length, Span, Unit, Window


class WindowParser(TokenCursor):
    """Reads units of time and checks windows."""

    window_example: ClassVar[str]
    range_example: ClassVar[str]

    def unit(self) -> Unit:
        """Reads the unit at hand, or gives up."""
        return self.unit_at_hand() or self._refuse_unit()

    def _refuse_unit(self) -> NoReturn:
        example = f"for example: {self.window_example}"
        if self.kinds[self.at] == "strange":
            self.expected("a unit: seconds, minutes, hours or days", example)
        if self.kinds[self.at] != "word" or self.starts_line(self.at):
            end = self.ends[self.at - 1]
            self.fail(
                "a unit is missing after the number: seconds, minutes, hours or days",
                Span(end, end),
                example,
            )
        written = self.token_text(self.at)
        self.fail(f"no unit is called {quoted(written)}", self.token_span(self.at), self.unit_hint(written.casefold()))

    def unit_at_hand(self) -> Unit | None:
        """Reads the unit at hand, if there is one."""
        if self.kinds[self.at] != "word" or self.token_text(self.at) not in UNITS:
            return None
        unit = self.token_text(self.at)
        self.at += 1
        return cast("Unit", unit if unit.endswith("s") else f"{unit}s")

    def unit_hint(self, word: str) -> str:
        """What to write instead of `word`, in lowercase, where a unit is expected."""
        return unit_hint(word)

    def check_length(self, length: Length) -> None:
        """Reports a length of time that no clock can measure."""
        seconds = length.seconds
        if seconds is not None and seconds > LONGEST:
            self.problem(f"this time is too long: {length}", length.span, f"write at most {LONGEST:,} seconds")

    def check_window(self, window: Window) -> None:
        """Reports a window that is too long, or ends before it begins."""
        for length in (window.start, window.end):
            if length is not None:
                self.check_length(length)
        if window.start is None or window.end is None:
            return
        begins, ends = window.start.seconds, window.end.seconds
        if begins is not None and ends is not None and begins > ends:
            self.problem(
                f"this window ends ({window.end}) before it begins ({window.start})",
                window.span,
                f"write the earlier end first, for example: {self.range_example}",
            )
