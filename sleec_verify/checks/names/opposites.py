"""Conditions that deny or exclude each other in words: a negation, or a word and its opposite."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from sleec_runtime.language.english.negations import is_clear, negation
from sleec_runtime.model import RELATIONS, Assume, Atom, Never, Ruleset, leaves
from sleec_runtime.support.word_forms import stems, words_of_each
from sleec_verify.checks.names.misreading import NEGATION, OPPOSITE, Misreading
from sleec_verify.checks.names.word_lists import (
    AUXILIARIES,
    COMPLEMENTS,
    CONTRACTIONS,
    NEGATING_PREFIXES,
    NEGATIONS,
    OPPOSITES,
)
from sleec_verify.encoding.relations import formulas_of_relation
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def negated_conditions(names: Sequence[str]) -> Iterator[Misreading]:
    """Conditions that differ from another one only by a negation, that begin with one, or that deny an opposite."""
    negated = [(name, words) for name, words in zip(names, words_of_each(names)) if not NEGATIONS.isdisjoint(words)]
    plain = {stems(name): name for name in reversed(names)} if negated else {}
    known = dict(zip(words_of_each(names), names)) if negated else {}
    for name, words in negated:
        left = [CONTRACTIONS.get(word, word) for word in words if word in CONTRACTIONS or word not in NEGATIONS]
        finite = [word for word in left if word not in AUXILIARIES]
        other = plain.get(stems(" ".join(left))) or plain.get(stems(" ".join(finite)))
        if other is not None and other != name:
            instead = f"NOT {other}"
            message = sentence(
                "{name} and {other} are read as two independent conditions", name=quoted(name), other=quoted(other)
            )
            if negation(name.replace("\u2019", "'").casefold().split()) is not None:
                yield Misreading(
                    NEGATION, name, message, sentence("write {instead}", instead=quoted(instead)), instead, other
                )
            else:
                advice = sentence(
                    "if they are exact opposites, write {instead}; otherwise, declare both", instead=quoted(instead)
                )
                yield Misreading(NEGATION, name, message, advice, other=other)
        elif words[0] == "not" and " " in name:
            message = sentence(
                "{name} is read as one name, including the word {word}", name=quoted(name), word=quoted(name.split()[0])
            )
            instead = f"NOT {name.split(maxsplit=1)[1]}"
            if is_clear(words[1:]):
                yield Misreading(NEGATION, name, message, sentence("write {instead}", instead=quoted(instead)), instead)
            else:
                yield Misreading(NEGATION, name, message, sentence("write NOT before each condition that is negated"))
        elif (same := _with_opposite(left, known)) is not None:
            message = sentence(
                "{name} and {other} are read as two independent conditions", name=quoted(name), other=quoted(same)
            )
            advice = sentence(
                "if they mean the same, write {other} in both places; otherwise, declare both", other=quoted(same)
            )
            yield Misreading(NEGATION, name, message, advice, other=same)


def _with_opposite(words: Sequence[str], known: Mapping[tuple[str, ...], str]) -> str | None:
    """The name of the words with an opposite in the place of one: `the light is off` for `the light is on`."""
    changed = ((*words[:at], OPPOSITES[word], *words[at + 1 :]) for at, word in enumerate(words) if word in OPPOSITES)
    return next((known[each] for each in changed if each in known), None)


def negated_triggers(triggers: Sequence[str], conditions: Sequence[str]) -> Iterator[Misreading]:
    """Triggers that deny a condition: `WHEN it is not night`, beside `it is night`."""
    known = frozenset(conditions)
    for one in negated_conditions([*conditions, *(name for name in triggers if name not in known)]):
        if one.name not in known and one.other in known:
            advice = sentence("name an event, and write {text} after it", text=quoted(f"AND NOT {one.other}"))
            yield one._replace(help=advice, instead=None)


def opposites(ruleset: Ruleset, names: Sequence[str]) -> Iterator[Misreading]:
    """Conditions that differ only by a word and its opposite, if nothing in the text relates them."""
    known = dict(zip(words_of_each(names), names))
    vocabulary = {word for words in known for word in words}
    opposite_of = {
        word: [o for o in (OPPOSITES.get(word), *(prefix + word for prefix in NEGATING_PREFIXES)) if o in vocabulary]
        for word in vocabulary
    }
    pairs = {
        (min(name, other), max(name, other)): _are_complements(word, opposite)
        for words, name in known.items()
        for at, word in enumerate(words)
        for opposite in opposite_of[word]
        if (other := known.get((*words[:at], opposite, *words[at + 1 :]))) is not None
    }
    related = _related(ruleset) if pairs else {}
    for (one, other), is_complement in sorted(pairs.items()):
        if related.get(one, frozenset()).isdisjoint(related.get(other, ())):
            message = sentence(
                "{name} and {other} are read as two independent conditions", name=quoted(other), other=quoted(one)
            )
            advice = sentence("exclude both together: {text}", text=quoted(f"ASSUME NOT ({one} AND {other})"))
            instead = f"NOT {one}" if is_complement else None
            if instead is not None:
                advice = sentence("write {instead} instead, or {advice}", instead=quoted(instead), advice=advice)
            yield Misreading(OPPOSITE, other, message, advice, instead, one)


def _are_complements(word: str, opposite: str) -> bool:
    """Whether one of the two is always true: of `dressed` and `undressed`, but not of `happy` and `unhappy`."""
    if opposite == OPPOSITES.get(word):
        return opposite == COMPLEMENTS.get(word)
    return word.endswith("ed")


def _related(ruleset: Ruleset) -> Mapping[str, set[int]]:
    """The constraints and relations that name each condition, by their positions."""
    related: dict[str, set[int]] = defaultdict(set)
    for position, statement in enumerate(ruleset.statements):
        if isinstance(statement, (Never, Assume, *RELATIONS)):
            for formula in formulas_of_relation(statement):
                for leaf in leaves(formula):
                    if isinstance(leaf, Atom):
                        related[leaf.name].add(position)
    return related
