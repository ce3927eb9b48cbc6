"""Names of a ruleset as symbols of one formula."""

from __future__ import annotations

from sleec_runtime.model import Kind, Ruleset


def symbol(ruleset: Ruleset, kind: Kind, name: str) -> str:
    """What to call a name where triggers and obligations share one space: an obligation that is a trigger too is
    ``due(name)``, as that it happened and that it is to be done are two things."""
    return f"due({name})" if kind == "obligation" and name in ruleset.triggers else name
