"""Negated conditions, such as ``it is not night``: the condition that they deny, where that is certain.

It is certain if the main verb is negated, and if no word leaves open how far the negation reaches. ``all doors are not
closed`` may mean that all are open. ``the user says that it is not night`` does not deny that the user says something.
"""

from __future__ import annotations

from collections.abc import Sequence

_VERBS = frozenset({"is", "are", "has", "have", "can", "does", "do"})
CONTRACTIONS = {
    **{f"{verb}n't": verb for verb in sorted(_VERBS - {"can"})},
    **dict.fromkeys(("cannot", "can't"), "can"),
}
"""Verbs that contain a negation, and the verb without it."""

_DETERMINERS = frozenset({"the", "this", "these", "those", "my", "your", "his", "her", "its", "our", "their"})
_NO_NOUNS = _VERBS | _DETERMINERS | {"it", "he", "she", "they", "i", "we", "you", "there", "a", "an"}
_LONGEST_SUBJECT = 3
"""The words of a subject with a determiner. In a longer one may be a verb, as in ``the user says Bob is not ill``."""

_QUANTIFIERS = """
all any every each some both either most many much few several none one half no
everybody everyone everything somebody someone something anybody anyone anything nobody nothing
everywhere somewhere anywhere nowhere always ever never often sometimes usually
"""
_MODALS = "must shall should may might will would could ought need needs"
_CONJUNCTIONS = """
and or but nor neither if unless because since until while when whenever before after although though
that which who whom whose where whether
"""
# prose: allow maybe, because it is a word of other people's texts
_ADVERBS = """
only just even also too yet still due except
maybe perhaps probably possibly likely certainly surely apparently allegedly presumably supposedly reportedly hopefully
"""
_TIMES = "seconds minutes hours days weeks months years"
_UNCLEAR = frozenset(f"{_QUANTIFIERS} {_MODALS} {_CONJUNCTIONS} {_ADVERBS} {_TIMES}".split())
"""Words with which a negation may reach less far than the whole phrase, or further."""


def negation(words: Sequence[str]) -> int | None:
    """The place of the word that negates the main verb of these `small_word`s; None if that is not certain. A negation
    denies the phrase without it: `not`, or a word in `CONTRACTIONS`."""
    places = [at for at, word in enumerate(words) if word == "not" or word in CONTRACTIONS]
    if len(places) != 1:
        return None
    at = places[0]
    verb = at - 1 if words[at] == "not" else at
    behind = words[at + 1 :]
    is_certain = (
        verb >= 0
        and (verb == at or words[verb] in _VERBS)
        and _is_subject(words[:verb])
        and behind[:1] not in ([], ["to"])
        and is_clear(behind)
    )
    return at if is_certain else None


def is_clear(words: Sequence[str]) -> bool:
    """Whether a negation before these `small_word`s denies all that they say."""
    return _UNCLEAR.isdisjoint(words)


def _is_subject(words: Sequence[str]) -> bool:
    """Whether these words are certainly a subject: nothing, one word, or a determiner and at most two words."""
    if len(words) < 2:
        return is_clear(words) and _DETERMINERS.isdisjoint(words)
    is_short = words[0] in _DETERMINERS and len(words) <= _LONGEST_SUBJECT
    return is_short and is_clear(words) and _NO_NOUNS.isdisjoint(words[1:])
