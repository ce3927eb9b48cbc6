"""Which rules of a ruleset count, and how they are read."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.model import Reading
    from sleec_verify.encoding.trace_scope import Untimed


class Scope(NamedTuple):
    """What `--reading`, `--domain`, `--untimed` and `--no-chains` say."""

    reading: Reading | None = None
    domain: str | None = None
    untimed: Untimed = "at"
    chains: bool = True


WHOLE = Scope()
"""All rules, as their text says how to read them."""
