"""A trace as the engine finds it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from sleec_runtime.model import Value


class TraceInstant(NamedTuple):
    """One instant of a trace: its time in seconds, its events, and the relevant conditions and measures."""

    time: int
    events: frozenset[str]
    conditions: Mapping[str, Value]
