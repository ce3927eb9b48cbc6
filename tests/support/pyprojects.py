"""The pyproject.toml of each distribution, as read."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import Any

from tests.support.paths import ROOT


def _read(path: Path) -> dict[str, Any]:
    toml = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    content: dict[str, Any] = toml.loads(path.read_text(encoding="utf-8"))
    return content


VERIFY = _read(ROOT / "pyproject.toml")
RUNTIME = _read(ROOT / "sleec_runtime" / "pyproject.toml")
