"""Traces of one ruleset that answer the questions about a similar one.

A trace that shows that a rule can be violated or triggered often shows the same after a change of other rules. The
evaluator confirms this faster than a solver finds another trace. An answer without a trace is asked again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.results.found_trace import FoundTrace

Confirm = Callable[["Ruleset", "Untimed", "FoundTrace"], bool]
"""Whether the evaluator confirms what a trace shows about a ruleset."""

_current: ContextVar[KnownTraces | None] = ContextVar("known_traces", default=None)


class KnownTraces:
    """The last trace that answered each question."""

    def __init__(self, confirm: Confirm) -> None:
        self._confirm = confirm
        self._known: dict[object, FoundTrace] = {}

    def still_shown(self, asked: FoundTrace, untimed: Untimed) -> FoundTrace | None:
        """The question `asked`, which has no instants, with a known trace that answers it; None if there is none."""
        known = self._known.get(_key(asked))
        if known is None:
            return None
        found = asked._replace(instants=known.instants)
        return found if self._confirm(asked.ruleset, untimed, found) else None

    def remember(self, found: FoundTrace) -> None:
        """Keep a trace for the next ruleset."""
        self._known[_key(found)] = found


def _key(found: FoundTrace) -> object:
    return found.shows, found.about


def known_traces() -> KnownTraces | None:
    """The known traces of this context, if there are any."""
    return _current.get()


@contextmanager
def using(known: KnownTraces) -> Iterator[None]:
    """Answer questions in the block by these traces, if they are confirmed, and remember new ones."""
    token = _current.set(known)
    try:
        yield
    finally:
        _current.reset(token)
