"""The names that a mission may use, and hints for the others."""

from __future__ import annotations

from sleec_runtime.model import Ruleset
from sleec_runtime.support.messages import represent
from sleec_runtime.support.suggestions import nearest

_MOST = 1_000
"""Unknown names that are remembered. Further ones are reported each time, without a hint."""


class Vocabulary:
    """The names of a ruleset. With `chains`, a trigger is also an obligation and vice versa: they are one event."""

    def __init__(self, ruleset: Ruleset, chains: bool) -> None:
        self.conditions = ruleset.conditions | ruleset.measures.keys()
        both = ruleset.triggers | ruleset.obligations
        self.events = both if chains else ruleset.triggers
        self.obligations = both if chains else ruleset.obligations
        self.domains = frozenset(ruleset.domains)
        self.reported: set[tuple[str, str]] = set()

    def unknown(self, kind: str, name: str) -> str | None:
        """What is wrong with a name, with a hint; None if it was reported before."""
        if (kind, name) in self.reported:
            return None
        missing = f"the ruleset has no {kind} {represent(name)}"
        if len(self.reported) >= _MOST:
            return missing
        self.reported.add((kind, name))
        known = self._kinds()
        wrong = next((f"an {k}" if k[0] in "aeio" else f"a {k}" for k, names in known.items() if name in names), None)
        if wrong is not None:
            return f"{missing}: this is {wrong}"
        near = nearest(name, sorted(known[kind]))
        return f"{missing}; did you mean `{near}`?" if near else missing

    def _kinds(self) -> dict[str, frozenset[str]]:
        return {
            "event": self.events,
            "obligation": self.obligations,
            "condition": frozenset(self.conditions),
            "domain": self.domains,
        }
