"""The comments of a text of rules."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Comments:
    """The comments of one line of rules, without their markers: the lines `above` it, and the one `behind` it."""

    above: tuple[str, ...] = ()
    behind: str | None = None


NO_COMMENTS = Comments()
