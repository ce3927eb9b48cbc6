"""How missions are audited."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.audit.auditor import TOLERANCE
from sleec_runtime.audit.mapping_file import read_mapping
from sleec_runtime.audit.source import Source
from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.model import Rational, Ruleset


class Settings(NamedTuple):
    """How a mission is audited: see `Auditor`. `sources` are those of the mapping. Observations that are up to
    `max_lag` seconds late are sorted by time. With `late`, the mission began before the log."""

    domain: str | None = None
    tolerance: Rational = TOLERANCE
    untimed: Untimed = "at"
    chains: bool = True
    sources: tuple[Source, ...] = ()
    max_lag: Rational = 0
    late: bool = False

    def with_mapping(self, path: str, ruleset: Ruleset) -> Settings:
        """These settings with the sources in a file, and with its tolerance, if it has one. Raises MappingError."""
        mapping = read_mapping(path, ruleset, self.chains)
        tolerance = self.tolerance if mapping.tolerance is None else mapping.tolerance
        return self._replace(sources=mapping.sources, tolerance=tolerance)
