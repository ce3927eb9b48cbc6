"""Sentences in other languages."""

from __future__ import annotations

from typing import Literal, get_args

from sleec_verify.wording.catalogue import catalogue_of
from sleec_verify.wording.sentence import Sentence

Language = Literal["en", "it", "de"]
LANGUAGES: tuple[Language, ...] = get_args(Language)


def translated(text: str, language: Language) -> str:
    """A sentence in a language, with the sentences among its values. Plain text, and a template that the catalogue
    does not have, stay as they are."""
    if language == "en" or not isinstance(text, Sentence):
        return text
    catalogue = catalogue_of(language)
    template = text.template if text.many is None or text.number == 1 else text.many
    values = {
        name: translated(value, language) if isinstance(value, str) else value for name, value in text.values.items()
    }
    return catalogue.get(template, template).format(**values)
