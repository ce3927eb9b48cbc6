"""Output for people and programs: one renderer for each format, over the same outcomes and findings.

A renderer is a module of this package with ``render(outcomes, palette) -> Iterator[str]``. Its strings are written one
after the other without change. A renderer decides nothing: the findings contain all results.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_verify.report.outcome import Outcome
    from sleec_verify.report.palette import Palette

FORMATS: tuple[str, ...] = ("full", "concise", "json", "sarif", "junit", "github", "gitlab")
"""The names that `--format` takes; each is the name of its module."""


def renderer(name: str) -> Callable[[Sequence[Outcome], Palette], Iterator[str]]:
    """The renderer of a format. Imports only the module of that format."""
    render: Callable[[Sequence[Outcome], Palette], Iterator[str]] = import_module(f"{__name__}.{name}").render
    return render
