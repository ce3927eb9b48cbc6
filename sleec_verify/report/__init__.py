"""What people and programs read: one renderer a format, over the same outcomes and findings.

A renderer is a module of this package with ``render(outcomes, palette) -> Iterator[str]``, whose strings are
written one after the other as they are. It decides nothing: what is wrong, and how bad that is, stands in the findings.
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
    """The renderer of a format. Only its module is imported."""
    render: Callable[[Sequence[Outcome], Palette], Iterator[str]] = import_module(f"{__name__}.{name}").render
    return render
