"""Every place of a name in the text, word for word: for messages about the name, and for changes of it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Mapping

from sleec_runtime.language.common.token_cursor import composed
from sleec_runtime.model import Claim, Rule, Ruleset, Span


def name_places(ruleset: Ruleset, names: Collection[str]) -> Mapping[str, list[Span]]:
    """The places of these names in rules, constraints and declarations, in text order.

    Labels and domains are not among them.
    """
    return _in_dsl(ruleset, names) if ruleset.syntax == "dsl" else _in_english(ruleset, names)


def _in_dsl(ruleset: Ruleset, names: Collection[str]) -> Mapping[str, list[Span]]:
    from sleec_runtime.language.dsl.scanner import scan

    tokens = scan(ruleset.source.text)
    labels = {statement.label_span for statement in ruleset.statements if isinstance(statement, (Rule, Claim))}
    places: dict[str, list[Span]] = defaultdict(list)
    for place in map(Span, tokens.starts, tokens.ends):
        word = tokens.text[slice(*place)]
        if word in names and place not in labels:
            places[word].append(place)
    return places


def _in_english(ruleset: Ruleset, names: Collection[str]) -> Mapping[str, list[Span]]:
    from sleec_runtime.language.english.keywords import CLAIMS, PHRASE, RELATION_WORDS, STATEMENTS
    from sleec_runtime.language.english.modal_verbs import modal_verb, small_word
    from sleec_runtime.language.english.scanner import scan

    tokens = scan(ruleset.source.text)
    kinds = tokens.kinds
    used = ruleset.triggers | ruleset.conditions | ruleset.obligations
    separators = {"RELATION": RELATION_WORDS, "EVENT": frozenset({"BY"})}
    places: dict[str, list[Span]] = defaultdict(list)
    statement = ""
    at = 0
    while kinds[at] != "end":
        first = at
        if kinds[at] == "word":
            ends_before = separators.get(statement, frozenset[str]())
            while kinds[at] in PHRASE and tokens.text_of(at) not in ends_before:
                at += 1
            is_name = statement != "DOMAIN" and kinds[first - 1] not in CLAIMS | {"RULE"}
            if at > first and is_name:
                words = [tokens.text_of(token) for token in range(first, at)]
                name = composed(" ".join(words))
                modal = None if name in used else modal_verb(list(map(small_word, words)))
                if modal is not None:
                    first += modal.words
                    name = composed(" ".join(words[modal.words :]))
                if name in names:
                    places[name].append(Span(tokens.starts[first], tokens.ends[at - 1]))
        elif kinds[at] in STATEMENTS:
            statement = kinds[at]
        at = max(at, first + 1)
    return places
