"""Names whose words say more than the rules know: negations, modal verbs, comparisons, opposites, keywords, variants.

A phrase is one name, unless the language reads it as a form of plain English: `the robot is not allowed to leave` is an
obligation of that name. A declaration says that a name is meant as it is written, so declared names of structured
English have no findings here. In the DSL, where every name is declared, only variants of one name are reported. In
both languages, a comment can allow a finding: ``// sleec: allow SLEEC525 because …``.
"""

from __future__ import annotations

from bisect import bisect
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from functools import lru_cache

from sleec_runtime.model import DeclaredKind, Ruleset, Source, Span
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.names.misreading import KINDS, Misreading
from sleec_verify.encoding.name_places import name_places
from sleec_verify.encoding.name_uses import mentions, names_used
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.results.suppressions import suppressions
from sleec_verify.wording.sentence import sentence


def _misread(index: RulesetIndex) -> Iterator[Finding]:
    """The findings, except those that a comment in the text allows."""
    ruleset = index.ruleset
    found = misreadings(ruleset, index.names_used)
    if found:
        allowing = suppressions(ruleset)[0]
        for finding in _findings(ruleset, found):
            if not any(one.covers(ruleset, finding) for one in allowing):
                yield finding


def _findings(ruleset: Ruleset, found: list[Misreading]) -> Iterator[Finding]:
    places = _places(ruleset, found)
    starts = [rule.span.start for rule in ruleset.rules]
    for one in found:
        other = places[one.other][:1] if one.other is not None else []
        around = dict.fromkeys(bisect(starts, span.start) - 1 for span in places[one.name])
        yield MISREAD_NAME.finding(
            one.message,
            next(iter(places[one.name]), None) or mentions(ruleset, one.name)[0],
            kind=one.kind,
            rules=tuple(ruleset.rules[at].label for at in around if at >= 0),
            help=one.help,
            related=tuple((span, sentence("the other name")) for span in other),
        )


def replacements(ruleset: Ruleset, finding: Finding) -> tuple[tuple[Span, str], ...]:
    """The text to write instead for a finding of this check: every place of its name, each with its new text.

    Empty if only the author knows what to write.
    """
    return _replacements(ruleset, ruleset.source).get((finding.code, finding.span), ())


@lru_cache(maxsize=1)  # whoever asks for one finding asks for the others of the ruleset
def _replacements(ruleset: Ruleset, source: Source) -> Mapping[tuple[str, Span], tuple[tuple[Span, str], ...]]:
    """The replacements for each code and first place. `source` is that of the ruleset: equal rules may have others."""
    misread = misreadings(ruleset, names_used(ruleset))
    places = _places(ruleset, misread)
    found: dict[tuple[str, Span], tuple[tuple[Span, str], ...]] = {}
    for one in misread:
        for first in places[one.name][:1]:
            changes = () if one.instead is None else tuple((span, one.instead) for span in places[one.name])
            found.setdefault((MISREAD_NAME.kinds[one.kind].code, first), changes)
    return found


def _places(ruleset: Ruleset, found: list[Misreading]) -> Mapping[str, list[Span]]:
    return defaultdict(list, name_places(ruleset, {name for one in found for name in (one.name, one.other) if name}))


def misreadings(ruleset: Ruleset, used: Mapping[DeclaredKind, Collection[str]]) -> list[Misreading]:
    """The names among those `used` that people read differently than the rules do, each at most once."""
    from sleec_verify.checks.names.variants import variants

    declared = frozenset[str]()
    found: list[Misreading] = []
    if ruleset.syntax != "dsl":
        declared = declared.union(*ruleset.declared.values(), (n for n, m in ruleset.measures.items() if m.declared))
        phrases = {kind: sorted(n for n in used[kind] if " " in n and n not in declared) for kind in KINDS}
        if any(phrases.values()):
            from sleec_verify.checks.names.opposites import negated_conditions, negated_triggers, opposites
            from sleec_verify.checks.names.phrases import misread_phrases

            found += misread_phrases(ruleset, phrases)
            found += negated_conditions(phrases["condition"])
            found += negated_triggers(phrases["trigger"], phrases["condition"])
            found += opposites(ruleset, phrases["condition"])
    found += (one for one in variants(ruleset, used, declared) if one.name not in declared)
    return list({one.name: one for one in reversed(found)}.values())


def _if_meant(code: str) -> str:
    return sentence(
        "If the name is meant as it is written, declare it, or allow it with a comment that "
        "gives a reason: // sleec: allow {code} because REASON.",
        code=code,
    )


MISREAD_NAME = Check(
    "misread-name",
    "Does every name mean what its words say?",
    (
        FindingKind(
            "SLEEC520",
            "warning",
            "a negation inside a name",
            "A name contains a word such as `not` or `never`. It is read as one name. An obligation with such a name "
            "requires what its words forbid. A condition with such a name is independent of the condition without the "
            "negation.",
            f"Write the keyword NOT before the name without the negation. {_if_meant('SLEEC520')}",
            "WHEN the user sleeps THEN the robot is not allowed to play music\n",
            "WHEN the user sleeps THEN NOT play music\n",
        ),
        FindingKind(
            "SLEEC521",
            "warning",
            "a modal verb inside an obligation",
            "An obligation contains a word such as `must` or `should`. The words are part of its name, so the same "
            "action without them is a different obligation.",
            f"Write only the action: THEN says that the robot must do it. {_if_meant('SLEEC521')}",
            "WHEN the user falls THEN the robot has to call the nurse\n",
            "WHEN the user falls THEN call the nurse\n",
        ),
        FindingKind(
            "SLEEC522",
            "warning",
            "a comparison inside a name",
            "A name contains words such as `under 6`, or says something about a measure without an operator. The words "
            "are read as one name, so it is independent of the measure and of other comparisons.",
            f"Declare a measure, and compare it with an operator. {_if_meant('SLEEC522')}",
            "WHEN the door opens THEN greet\nUNLESS the age is under 6 IN WHICH CASE wave\n",
            "MEASURE age: number\nWHEN the door opens THEN greet\nUNLESS age < 6 IN WHICH CASE wave\n",
        ),
        FindingKind(
            "SLEEC523",
            "warning",
            "two conditions that are opposites",
            "Two conditions differ only by a word and its opposite, such as `open` and `closed`. The rules do not say "
            "that they exclude each other. So `check` also examines situations in which both are true, and situations "
            "in which neither is true.",
            "Use one of the two, with NOT for the other. If both can be false at the same time, "
            "keep both names, and exclude with ASSUME that both are true.",
            "WHEN the bell rings THEN go in\nUNLESS the door is closed IN WHICH CASE knock\n"
            "WHEN the guest leaves THEN close the door\nUNLESS the door is open IN WHICH CASE wait\n",
            "WHEN the bell rings THEN go in\nUNLESS the door is closed IN WHICH CASE knock\n"
            "WHEN the guest leaves THEN close the door\nUNLESS NOT the door is closed IN WHICH CASE wait\n",
        ),
        FindingKind(
            "SLEEC524",
            "warning",
            "a word in capitals that is not a keyword",
            "A name contains a word in capitals that looks like a keyword, such as BUT or IMMEDIATELY. Structured "
            "English has no such keyword. The word is part of the name.",
            f"Use the keyword of structured English, or leave the word out. {_if_meant('SLEEC524')}",
            "WHEN the user falls THEN call the nurse IMMEDIATELY\n",
            "WHEN the user falls THEN call the nurse\n",
        ),
        FindingKind(
            "SLEEC525",
            "warning",
            "two names that differ only slightly",
            "Two names differ only by an article, by capitals, or by singular and plural. They are two names. A rule "
            "about one does not conflict with a rule about the other.",
            "Use one spelling everywhere. If you mean two different things, choose names that differ more, or allow "
            "one with a comment: // sleec: allow SLEEC525 because REASON.",
            "WHEN the user falls THEN call the nurse\nWHEN the user rings THEN call nurse\n",
            "WHEN the user falls THEN call the nurse\nWHEN the user rings THEN call the nurse\n",
        ),
        FindingKind(
            "SLEEC526",
            "note",
            "a name that may be a slip",
            "A name that is used once differs from a more frequent name by one letter, by `is` and `are`, or by the "
            "form of its first verb. They are two names. A rule about one does not conflict with a rule about the "
            "other.",
            f"If you mean the same, use one spelling everywhere. {_if_meant('SLEEC526')}",
            "WHEN the user falls THEN call the nurse\nWHEN the user rings THEN call the nurse\n"
            "WHEN the alarm rings THEN call the nruse\n",
            "WHEN the user falls THEN call the nurse\nWHEN the user rings THEN call the nurse\n"
            "WHEN the alarm rings THEN call the nurse\n",
        ),
    ),
    _misread,
    scope="text",
)

ALLOWED_BY_COMMENTS = frozenset({MISREAD_NAME.name, *(kind.code for kind in MISREAD_NAME.kinds)})
"""The codes, and the name of the check, that a comment in the text allows for every command, not only for the gate."""
