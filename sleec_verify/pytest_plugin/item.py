"""The base of the plugin's items, and their failures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.errors import SleecError
from sleec_verify.conformance.failure import Nonconformance


class CaseFailure(AssertionError):
    """The failure of an item, in words."""


class Item(pytest.Item):
    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        if isinstance(excinfo.value, (CaseFailure, Nonconformance, SleecError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        return self.path, self.line(), self.name

    def line(self) -> int | None:
        return None


def check_names(where: str, what: str, written: tuple[str, ...], found: tuple[str, ...]) -> None:
    """Raises CaseFailure if a case names other obligations or prohibitions than the rules."""
    if set(written) != set(found):
        raise CaseFailure(
            f"{where}:\n  {what} of the case:  {', '.join(written) or 'none'}\n"
            f"  {what} by the rules: {', '.join(dict.fromkeys(found)) or 'none'}"
        )
