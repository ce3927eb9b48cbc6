"""Elements of a page. Text is added as it is; `finished` translates it, escapes it, and marks names in it."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Union
from xml.etree.ElementTree import Element, SubElement, tostring

from sleec_runtime.support.messages import escaped
from sleec_verify.wording.names import spoken
from sleec_verify.wording.sentence import Sentence
from sleec_verify.wording.translation import Language, translated

Child = Union[Element, str, None]

_NAME = re.compile(r"`([^`]+)`")
_VERBATIM = ("code", "pre", "style", "title")
"""Elements in which backticks do not mark names."""
_READY = ("style", "svg")
"""Elements that stay as they are."""
_WORDS = ("aria-label", "alt", "title")
"""Attributes that people read."""
_CAPITALS = ("caption", "dd", "dt", "figcaption", "h3", "h4", "li", "p", "summary")
"""Elements whose sentences begin with a capital letter."""


def element(tag: str, *children: Child, **attributes: str | None) -> Element:
    """``element("p", "text", kind="note")``: `kind` is the class, and underscores in the names of attributes are
    hyphens. Children and attributes that are None are left out."""
    named = {
        "class" if name == "kind" else name.rstrip("_").replace("_", "-"): value for name, value in attributes.items()
    }
    found = Element(tag, {name: value for name, value in named.items() if value is not None} if named else {})
    for child in children:
        if isinstance(child, str):
            _add_text(found, child)
        elif child is not None:
            found.append(child)
    return found


def _add_text(parent: Element, text: str) -> None:
    """Add a text after the last child. Two texts in a row stay apart, because each has its own translation."""
    last = parent[-1] if len(parent) else None
    if last is None and not parent.text:
        parent.text = text
    elif last is not None and not last.tail:
        last.tail = text
    else:
        SubElement(parent, "span").text = text


def finished(page: Element, language: Language, names: Collection[str] = ()) -> str:
    """The page as HTML. In backticks, each of the `names` becomes words in quotes, and all else becomes code. A
    paragraph, heading or item begins with a capital letter. All text is escaped."""
    _Finish(language, frozenset(names)).finish(page)
    return "<!DOCTYPE html>\n" + tostring(page, encoding="unicode", method="html") + "\n"


def _begins_with_name(text: str) -> bool:
    """Whether a text has no words of a template at its beginning."""
    if not isinstance(text, Sentence):
        return True
    template = text.template.lstrip()
    if not template.startswith("{"):
        return False
    value = text.values.get(template[1 : template.index("}")])
    return not isinstance(value, str) or _begins_with_name(value)


class _Finish:
    """The last changes of a page, in one language."""

    def __init__(self, language: Language, names: Collection[str]) -> None:
        self._language = language
        self._names = names

    def finish(self, one: Element) -> None:
        for name in _WORDS if one.attrib else ():
            if name in one.attrib:
                one.set(name, escaped(translated(one.attrib[name], self._language)))
        verbatim = one.tag in _VERBATIM
        # From the last child on, so that new elements do not move the others.
        for place in range(len(one) - 1, -1, -1):
            child = one[place]
            if child.tag not in _READY:
                self.finish(child)
            if child.tail:
                child.tail, named = self._marked(child.tail, verbatim)
                one[place + 1 : place + 1] = named
        if one.text:
            is_capital = one.tag in _CAPITALS and not _begins_with_name(one.text)
            one.text, named = self._marked(one.text, verbatim)
            if is_capital and not one.text[:1].isupper():
                one.text = re.sub(r"^\s*\w", lambda first: first[0].upper(), one.text)
            one[0:0] = named

    def _marked(self, text: str, verbatim: bool) -> tuple[str, list[Element]]:
        """The text before the first name in backticks, and the elements for the names, each with the text behind it."""
        words = translated(text, self._language)
        if verbatim:
            return escaped(words, "\n\t"), []
        if "`" not in words:
            return escaped(words), []
        before, *rest = _NAME.split(words)
        found = []
        for name, after in zip(rest[::2], rest[1::2]):
            one = self._name(name)
            one.tail = escaped(after)
            found.append(one)
        return escaped(before), found

    def _name(self, name: str) -> Element:
        if name not in self._names:
            return element("code", escaped(name))
        words = spoken(name)
        return element("q", escaped(words), title=None if words == name else escaped(name))
