"""Names of a ruleset as symbols of one formula."""

from __future__ import annotations

from sleec_runtime.model import Kind, Ruleset


def symbol(ruleset: Ruleset, kind: Kind, name: str) -> str:
    """The symbol of a name, if triggers and obligations share one name space: an obligation that is also a trigger
    is ``due(name)``, because its occurrence and its obligation are different atoms."""
    return f"due({name})" if kind == "obligation" and name in ruleset.triggers else name


def escaped(text: str) -> str:
    """A text as LaTeX."""
    for character in "_#%&$":
        text = text.replace(character, f"\\{character}")
    return text.replace(" ", r"\ ")
