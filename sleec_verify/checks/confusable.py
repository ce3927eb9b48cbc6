"""Deceptive text: look-alike words, mixed scripts, unusual letters, bidirectional controls (UTS #39, #55).

All of these need a character outside ASCII, so an ASCII text is not examined.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from sleec_runtime.model import Ruleset, Span
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

_DIRECTION = re.compile("[\u202a-\u202e\u2066-\u2069]")


def _confusable(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    if not ruleset.source.text.isascii():
        words, keywords = _words(ruleset)
        alike = _alike(words, keywords)
        for word, other in alike.items():
            yield _looks_like(ruleset, words, word, other, other in keywords)
        yield from _odd(ruleset, {word: span for word, span in words.items() if word not in alike})
        yield from _directions(ruleset)


def _words(ruleset: Ruleset) -> tuple[dict[str, Span], frozenset[str]]:
    """The names, labels and keywords in a text, word by word, each with its first place; and all keywords of the
    language. Comments are left out."""
    if ruleset.syntax == "dsl":
        from sleec_runtime.language.dsl.keywords import KEYWORDS
        from sleec_runtime.language.dsl.scanner import scan
    else:
        from sleec_runtime.language.english.keywords import KEYWORDS
        from sleec_runtime.language.english.scanner import scan
    text = ruleset.source.text
    tokens = scan(text)
    words: dict[str, Span] = {}
    for start, end in zip(tokens.starts, tokens.ends):
        words.setdefault(text[start:end], Span(start, end))
    return words, frozenset(KEYWORDS)


def _alike(words: dict[str, Span], keywords: frozenset[str]) -> dict[str, str]:
    """Each word that looks like another one, with that one: preferably in ASCII, and among these a keyword."""
    from sleec_verify.checks.skeleton import skeleton

    groups: dict[str, list[str]] = {skeleton(word): [] for word in words if not word.isascii()}
    for word in sorted({*words, *keywords}, key=lambda word: (not word.isascii(), word not in keywords, word)):
        groups.get(skeleton(word), []).append(word)
    # Words that differ only in ASCII, such as by l and 1, do not mix scripts.
    return {
        word: first
        for first, *others in groups.values()
        for word in others
        if _beyond_ascii(word) != _beyond_ascii(first)
    }


def _beyond_ascii(word: str) -> set[str]:
    return {c for c in word if not c.isascii()}


def _looks_like(ruleset: Ruleset, words: dict[str, Span], word: str, other: str, is_keyword: bool) -> Finding:
    from sleec_verify.checks.skeleton import described

    span, place = words[word], words.get(other)
    one, two = _beyond_ascii(word), _beyond_ascii(other)
    characters = described(c for c in word + other if c in one ^ two)
    return CONFUSABLE.finding(
        sentence(
            "{word} looks like {other}, but it is a different word: {contains}",
            word=quoted(word),
            other=sentence("the keyword {word}", word=quoted(other)) if is_keyword else quoted(other),
            contains=sentence("it contains {characters}", characters=characters)
            if one - two
            else sentence("the other word contains {characters}", characters=characters),
        ),
        span,
        rules=_rules_at(ruleset, span),
        note=None
        if is_keyword
        else sentence("rules about one word do not apply to the other, so no conflict between them is found"),
        help=sentence("if you mean the same word, write {other}", other=quoted(other)),
        related=() if place is None else ((place, sentence("the similar word")),),
    )


def _odd(ruleset: Ruleset, words: dict[str, Span]) -> Iterator[Finding]:
    """The words with invisible or unusual characters, and those that mix scripts."""
    from sleec_verify.checks.skeleton import described, foreign_letters, odd_characters, plain

    for word, span in words.items():
        if word.isascii():
            continue
        if odd := odd_characters(word):
            yield CONFUSABLE.finding(
                sentence("{word} contains {characters}", word=quoted(word), characters=described(odd)),
                span,
                kind=2,
                rules=_rules_at(ruleset, span),
                help=sentence("write {plain}", plain=quoted(plain(word))),
            )
        elif foreign := foreign_letters(word):
            yield CONFUSABLE.finding(
                sentence(
                    "{word} mixes scripts: it contains {characters}", word=quoted(word), characters=described(foreign)
                ),
                span,
                kind=1,
                rules=_rules_at(ruleset, span),
                help=sentence("use the letters of one script"),
            )


def _directions(ruleset: Ruleset) -> Iterator[Finding]:
    """The lines with bidirectional controls, also in comments."""
    from sleec_verify.checks.skeleton import described

    source = ruleset.source
    by_line: dict[int, list[int]] = {}
    for found in _DIRECTION.finditer(source.text):
        by_line.setdefault(source.place(Span(*found.span())).line, []).append(found.start())
    for places in by_line.values():
        span = Span(places[0], places[-1] + 1)
        yield CONFUSABLE.finding(
            sentence("this line contains {characters}", characters=described(source.text[at] for at in places)),
            span,
            kind=3,
            rules=_rules_at(ruleset, span),
            note=sentence("an editor may show the characters of this line in a different order"),
            help=sentence("remove these characters"),
        )


def _rules_at(ruleset: Ruleset, span: Span) -> tuple[str, ...]:
    return tuple(rule.label for rule in ruleset.rules if rule.span.start <= span.start < rule.span.end)


CONFUSABLE = Check(
    "confusable",
    "Is every word what it looks like?",
    (
        FindingKind(
            "SLEEC515",
            "warning",
            "two words that look alike",
            "Two names, or a name and a keyword, look the same but consist of different characters, for example a "
            "Cyrillic \u041e instead of a Latin O. For the rules they are different words. A rule that forbids one "
            "does not conflict with a rule that requires the other.",
            "Use one spelling everywhere. If you mean two different things, choose names that look different.",
            "WHEN DoorbellRings THEN OpenDoor\nWHEN NightFalls THEN NOT \u041epenDoor\n",
            "WHEN DoorbellRings THEN OpenDoor\nWHEN NightFalls THEN NOT \u00d6ffneFenster\n",
        ),
        FindingKind(
            "SLEEC516",
            "warning",
            "a name that mixes scripts",
            "A name contains letters of several scripts, for example one Cyrillic letter among Latin ones. Readers "
            "take it for a name in one script, and may write it so in assertions, policies and code.",
            "Use the letters of one script.",
            "WHEN D\u043e\u043erbellRings THEN Answer\n",
            "WHEN DoorbellRings THEN \u041e\u0442\u0432\u0435\u0442\u0438\u0442\u044c\n",
        ),
        FindingKind(
            "SLEEC517",
            "warning",
            "a name with an invisible or unusual character",
            "A name contains an invisible character, or a full-width, mathematical or other variant of a letter. "
            "The name differs from the one that readers see.",
            "Write the name in ordinary letters.",
            "WHEN \uff24oorbellRings THEN Answer\n",
            "WHEN DoorbellRings THEN Answer // \uff24oorbell\n",
        ),
        FindingKind(
            "SLEEC518",
            "warning",
            "a control character that changes the writing direction",
            "The text contains a bidirectional control character. It changes the order in which an editor shows the "
            "line, so readers see different rules than sleec-verify (CVE-2021-42574).",
            "Remove it. Scripts that are written from right to left do not need it.",
            "WHEN DoorbellRings THEN Answer // \u202eebyam\n",
            "WHEN DoorbellRings THEN Answer // \u05d0\u05d5\u05dc\u05d9\n",
        ),
    ),
    _confusable,
    scope="text",
)
