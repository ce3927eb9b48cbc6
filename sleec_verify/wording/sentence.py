"""Sentences that remember their template and their values, so that they can be translated later."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Union


class Sentence(str):
    """Text in English, with the template and the values that it is made of.

    It is equal to the plain text, so everything that does not translate can use it as a `str`. Text that is derived
    from it, such as a slice, is plain and stays English. `many` is the template of the plural; `number` selects between
    both templates.
    """

    __slots__ = ("many", "number", "template", "values")

    template: str
    values: Mapping[str, Value]
    many: str | None
    number: int

    def __new__(cls, template: str, values: Mapping[str, Value], many: str | None = None, number: int = 1) -> Sentence:
        one = super().__new__(cls, (template if many is None or number == 1 else many).format(**values))
        one.template, one.values, one.many, one.number = template, values, many, number
        return one

    def __str__(self) -> str:
        """The sentence itself, so that `str(error)` keeps it, too."""
        return self

    def __reduce__(self) -> tuple[type[Sentence], tuple[object, ...]]:
        return Sentence, (self.template, self.values, self.many, self.number)


Value = Union[str, int, Sentence]
"""A value of a template: a name or a number, which no translation changes, or another sentence."""


def sentence(template: str, /, **values: Value) -> str:
    """``sentence("rule {rule} never applies", rule=quoted(label))``. `template` must be a literal, because a test
    compares the literals with the catalogues."""
    return Sentence(template, values)


def plural(number: int, one: str, many: str, /, **values: Value) -> str:
    """The sentence `one` if `number` is 1, otherwise `many`. Both templates are literals and may name ``{number}``."""
    return Sentence(one, {"number": number, **values}, many, number)


def joined(separator: str, parts: Iterable[str]) -> str:
    """Like ``separator.join(parts)``, for a separator without words. No catalogue has its template."""
    values = {f"part{number}": part for number, part in enumerate(parts)}
    return Sentence(separator.replace("{", "{{").replace("}", "}}").join(f"{{{name}}}" for name in values), values)
