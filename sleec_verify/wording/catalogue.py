"""Catalogues of translations: PO files, as gettext and the editors of translators use them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

_LINE = re.compile(r'(?:(msgid|msgid_plural|msgstr)(?:\[(\d)\])? )?"(.*)"')
_ESCAPES = {"n": "\n", "t": "\t", '"': '"', "\\": "\\"}


@cache
def catalogue_of(language: str) -> Mapping[str, str]:
    """The translation of each template, and that of the plural for each template of a plural.

    Raises FileNotFoundError if there is no catalogue for the language.
    """
    from importlib.resources import files

    return read_catalogue((files(__package__) / "locale" / f"{language}.po").read_text("utf-8"))


def read_catalogue(text: str) -> dict[str, str]:
    """The translations in the text of a PO file for a language with one plural: number 0 is for 1, number 1 for all
    others. Raises ValueError for a line of another kind."""
    found: dict[str, str] = {}
    entry: dict[str, str] = {}
    for line in (*text.splitlines(), ""):
        if line.startswith("#"):
            continue
        if not line.strip():
            found.update(_translations(entry))
            entry = {}
            continue
        match = _LINE.fullmatch(line)
        if match is None:
            raise ValueError(f"not a line of a PO file: {line}")
        keyword, number, content = match.groups()
        key = f"{keyword}{number or ''}" if keyword else list(entry)[-1]
        entry[key] = entry.get(key, "") + re.sub(r"\\(.)", lambda escape: _ESCAPES[escape[1]], content)
    return found


def _translations(entry: Mapping[str, str]) -> dict[str, str]:
    pairs = (("msgid", "msgstr"), ("msgid", "msgstr0"), ("msgid_plural", "msgstr1"))
    return {entry[one]: entry[other] for one, other in pairs if entry.get(one) and entry.get(other)}
