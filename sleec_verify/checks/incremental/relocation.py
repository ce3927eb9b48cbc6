"""Findings about statements that did not change, at the new places of these statements."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import replace

from sleec_runtime.model import Span
from sleec_verify.results.finding import Finding


class Relocation:
    """Moves spans inside statements from their old to their new places."""

    def __init__(self, moves: Iterable[tuple[Span, Span]]) -> None:
        """`moves` are the old and the new spans of the same statements."""
        found = sorted({old: new.start - old.start for old, new in moves}.items())
        self._starts = [old.start for old, _ in found]
        self._distances = [distance for _, distance in found]

    def finding(self, finding: Finding) -> Finding:
        """The finding at its new place."""
        span = self._moved(finding.span)
        related = tuple((self._moved(place), words) for place, words in finding.related)
        if span == finding.span and related == finding.related:
            return finding
        return replace(finding, span=span, related=related)

    def _moved(self, span: Span) -> Span:
        at = bisect_right(self._starts, span.start) - 1
        distance = self._distances[at] if at >= 0 else 0
        return Span(span.start + distance, span.end + distance)
