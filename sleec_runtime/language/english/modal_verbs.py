"""Modal verbs before an obligation, such as ``must not`` in ``THEN the robot must not leave``.

A response states an obligation or a prohibition, so only modal verbs with that meaning are read: ``must leave`` is the
obligation ``leave``, and ``must not leave`` is ``NOT leave``. Permissions such as ``may leave`` stay names.
"""

from __future__ import annotations

from typing import NamedTuple

_SUBJECT = ("the", "robot")
_DUE = ("must", "shall", "should")
_VERBS = (*_DUE, "may", "can", "will", "do", "does")
_CONTRACTIONS = ("mustn't", "shan't", "shouldn't", "can't", "won't", "don't", "doesn't")

_FORMS: tuple[tuple[tuple[str, ...], bool], ...] = (
    *(((verb, word), True) for verb in _VERBS for word in ("not", "never")),
    *(((word,), True) for word in ("never", "cannot", *_CONTRACTIONS)),
    *(((verb,), False) for verb in _DUE),
)
"""The forms, longest first, each with whether it forbids what follows it."""

STARTS = frozenset({_SUBJECT[0], *(words[0] for words, _ in _FORMS)})
"""The first words of the forms."""

_UNCLEAR = frozenset({"only", "not", "always"})
"""Words after a form that change its meaning: ``must not only``."""

_OMISSIONS = frozenset({"fail", "forget", "neglect", "omit"})
"""Verbs that deny the action after them: ``must not fail to leave`` requires ``leave``."""

_REFUSALS = frozenset({"refuse to", "decline to", "hesitate to", "refrain from", "abstain from"})
"""Words that a negation makes unclear: ``must not refuse to help`` may forbid an answer, or require help."""

_NECESSITIES = (("have", "to"), ("need", "to"))
"""Words that a negation makes a permission: ``should not have to leave``."""


class ModalVerb(NamedTuple):
    """A modal verb of this many words, with the subject before it."""

    words: int
    forbids: bool


def small_word(word: str) -> str:
    """A word in lowercase with a straight apostrophe, to compare it with words of English."""
    return word.casefold().replace("\u2019", "'")


def modal_verb(words: list[str]) -> ModalVerb | None:
    """The modal verb at the start of a phrase of these `small_word`s; None if there is none, or if its meaning is
    unclear, as in ``must never not``."""
    first = len(_SUBJECT) if tuple(words[:2]) == _SUBJECT else 0
    for form, forbids in _FORMS:
        end = first + len(form)
        if tuple(words[first:end]) == form:
            behind = words[end:]
            if forbids and denies_action(behind):
                is_due = omits_action(behind) and _is_clear(behind[2:]) and not denies_action(behind[2:])
                return ModalVerb(end + 2, False) if is_due else None
            is_permission = forbids and tuple(behind[:2]) in _NECESSITIES
            return ModalVerb(end, forbids) if _is_clear(behind) and not is_permission else None
    return None


def omits_action(words: list[str]) -> bool:
    """Whether these `small_word`s are an omission of the action after them, such as ``fail to leave``."""
    return words[0] in _OMISSIONS and words[1:2] == ["to"]


def denies_action(words: list[str]) -> bool:
    """Whether a negation before these `small_word`s may do more than forbid what they say."""
    return bool(words) and (
        words[0] in _OMISSIONS
        or " ".join(words[:2]) in _REFUSALS
        or (words[0] == "avoid" and "".join(words[1:2]).endswith("ing"))
    )


def _is_clear(words: list[str]) -> bool:
    """Whether none of the words after a form changes its meaning."""
    return not words or (words[0] not in _UNCLEAR and modal_verb(words) is None)
