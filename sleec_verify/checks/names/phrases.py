"""One phrase by itself: negations and modal verbs in an obligation, words in capitals that are not keywords."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from sleec_runtime.language.english.modal_verbs import denies_action, omits_action
from sleec_runtime.model import DeclaredKind, Ruleset, literals
from sleec_verify.checks.names.comparisons import comparisons
from sleec_verify.checks.names.measure_mentions import measure_mentions
from sleec_verify.checks.names.misreading import FOREIGN_KEYWORD, KINDS, MODAL, NEGATION, Misreading
from sleec_verify.checks.names.word_lists import (
    AUXILIARIES,
    CONTRACTIONS,
    FOREIGN,
    MODALS,
    NEGATIONS,
    NOT_DUTIES,
    OUTSIDE_OBLIGATIONS,
    PERMISSIONS,
    ROBOTS,
    SUPERFLUOUS,
)
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

_PERMITTED = "(?:allowed|permitted|required|supposed|obliged|able|free)"
_NOT = rf"(?:{'|'.join(sorted(NEGATIONS))})"
_MODAL = rf"(?:{'|'.join(sorted(MODALS))})"
_VERB_GROUP = (
    rf"(?:{_MODAL}|{_NOT}|(?:{'|'.join(sorted(AUXILIARIES))})(?= {_NOT} )|(?:has|have|needs?)(?= (?:{_NOT} )?to )"
    rf"|needs?(?= {_NOT} )|had better"
    rf"|(?:is|are|be)(?= (?:{_NOT} )?(?:to|{_PERMITTED}) )|{_PERMITTED}(?= to )|also|to|longer)"
)
_SAID = re.compile(
    rf"(?P<subject>(?:(?:the|a|an|this|your) )?(?:{'|'.join(ROBOTS)}) )?(?P<verbs>(?:{_VERB_GROUP} )+)(?P<action>.+)",
    re.IGNORECASE,
)
_OTHER_SUBJECT = re.compile(
    rf"(?:(?:the|a|an|no|any|every|all) (?:[\w'-]+ ){{1,3}}?|[\w'-]+ )(?P<verbs>(?:must|shall|should)(?: {_NOT})?) .+",
    re.IGNORECASE,
)
_FORBIDDING = re.compile(
    rf"(?:(?:(?:the|a|an|this|your) )?(?:{'|'.join(ROBOTS)}) )?(?:{_MODAL} )?"
    r"(?:(?:only|neither|nobody|no one|none|nothing|hardly|rarely|seldom|rather not|under no) .+"
    r"|(?:refrain|abstain) from .+|avoid \w+ing\b.*|\w+(?: \w+){0,3} never"
    r"|(?:(?:it|\w+ing(?: \w+){0,2}) )?(?:is|are) (?:forbidden|prohibited)\b.*)",
    re.IGNORECASE,
)
_BEFORE_ACTIONS = NEGATIONS | MODALS | {"has", "have", "need", "needs", "is", "are", "be", "better"}
_ADVERBS = ("only", "always", "ever", "just", "merely")
_FORBIDDEN = "name what the robot must not do, and write NOT before it, for example: NOT open the door"
_REQUIRED = "name what the robot must do, for example: open the door"
_IS = re.compile(r"\b(?:is|are)\b", re.IGNORECASE)
_IS_MODAL = re.compile(
    rf"\b(?:{_MODAL}|had better|(?:has|have|needs?|is|are|be) (?:{_PERMITTED} )?to)\b", re.IGNORECASE
)


def misread_phrases(ruleset: Ruleset, phrases: Mapping[DeclaredKind, Iterable[str]]) -> Iterator[Misreading]:
    """What people read in phrases, where that is not what the rules say."""
    foreign = {name: word for kind in KINDS for name in phrases[kind] if (word := _foreign_keyword(name)) is not None}
    for name, word in foreign.items():
        yield _foreign(ruleset, name, word)
    forbidden = {o.name for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause) if o.negated}
    for name in phrases["obligation"]:
        plain = name.replace("\u2019", "'")
        if name in foreign:
            continue
        if _FORBIDDING.fullmatch(plain):
            yield _in_obligation(name, True, _FORBIDDEN)
        elif omits_action(plain.casefold().split()):
            yield _with_denial(name)
        elif not _BEFORE_ACTIONS.isdisjoint(plain.casefold().split()):
            yield from _said(name, plain, name in forbidden)
    compared = {one.name: one for one in comparisons(ruleset, phrases["condition"]) if one.name not in foreign}
    yield from compared.values()
    rest = {kind: [name for name in phrases[kind] if name not in foreign and name not in compared] for kind in KINDS}
    yield from measure_mentions(ruleset, rest["condition"], rest["obligation"])
    for name in phrases["trigger"]:
        if name not in foreign and name.casefold().startswith("not "):
            message = sentence(
                "{name} is read as one name, including the word {word}", name=quoted(name), word=quoted(name[:3])
            )
            yield Misreading(
                NEGATION, name, message, sentence("name an event, and write AND NOT and a condition after it")
            )
    # An event such as `the temperature falls below 20` is what it says.
    events = [name for name in phrases["trigger"] if name not in foreign and _IS.search(name)]
    yield from map(_in_trigger, comparisons(ruleset, events, with_is=False))


def _foreign_keyword(name: str) -> str | None:
    return None if name.islower() else next((word for word in name.split() if word in FOREIGN), None)


def _in_trigger(found: Misreading) -> Misreading:
    comparison = found.instead or "age < 6"
    advice = sentence(
        "name an event, and write the comparison after AND, for example: WHEN the user calls AND {comparison}",
        comparison=comparison,
    )
    return found._replace(help=advice, instead=None)


def _foreign(ruleset: Ruleset, name: str, foreign: str) -> Misreading:
    words = name.split()
    at = words.index(foreign)
    before, after = " ".join(words[:at]), " ".join(words[at + 1 :])
    instead = None
    if name in ruleset.obligations:
        if foreign in SUPERFLUOUS:
            instead = " ".join(word for word in words if word not in SUPERFLUOUS)
    elif name in ruleset.conditions and before and after:
        instead = {
            "IMPLIES": f"(NOT {before} OR {after})",
            "XOR": f"(({before} AND NOT {after}) OR (NOT {before} AND {after}))",
            "NOR": f"NOT ({before} OR {after})",
            "BUT": f"({before} AND {after})",
        }.get(foreign)
    advice = (FOREIGN if name in ruleset.obligations else FOREIGN | OUTSIDE_OBLIGATIONS)[foreign]
    if instead:
        advice = sentence("{advice}; here, write {instead}", advice=advice, instead=quoted(instead))
    message = sentence("{name} is read as one name, including the word {word}", name=quoted(name), word=quoted(foreign))
    return Misreading(FOREIGN_KEYWORD, name, message, advice, instead or None)


def _said(name: str, plain: str, is_forbidden: bool) -> Iterator[Misreading]:
    """A negation or modal verb before the action of an obligation. `plain` is its name with straight apostrophes, and
    `is_forbidden` says that the rules have it after NOT."""
    found = _SAID.fullmatch(plain)
    if found is None:
        other = _OTHER_SUBJECT.fullmatch(plain)
        if other is not None:
            negated = not NEGATIONS.isdisjoint(other["verbs"].casefold().split())
            yield _in_obligation(name, negated, _FORBIDDEN if negated else _REQUIRED)
        return
    action = name[found.start("action") :]
    verbs = found["verbs"].casefold().split()
    modals = {CONTRACTIONS.get(verb, verb) for verb in verbs}
    negations = sum(verb in NEGATIONS for verb in verbs)
    if negations == 1 and (verbs[-1] == "no" or action.casefold().split()[0] in _ADVERBS):
        yield _in_obligation(name, True, _FORBIDDEN)
    elif negations and denies_action(action.casefold().split()):
        yield _with_denial(name)
    elif negations and (negations > 1 or is_forbidden or not NOT_DUTIES.isdisjoint(modals)):
        message = sentence("{name} is read as an obligation, including its negation", name=quoted(name))
        yield Misreading(NEGATION, name, message, _either(action))
    elif negations:
        instead = f"NOT {action}"
        yield _in_obligation(name, True, sentence("to forbid it, write {instead}", instead=quoted(instead)), instead)
    # "can" without a subject may be another word.
    elif found["subject"] or verbs[0] not in ("can", "to"):
        if is_forbidden and _IS_MODAL.search(found["verbs"]):
            yield _in_obligation(name, False, _either(action))
        elif not PERMISSIONS.isdisjoint(modals):
            advice = sentence(
                "a rule cannot permit an action: if the robot must do it, write {action}; or remove it",
                action=quoted(action),
            )
            yield _in_obligation(name, False, advice)
        elif _IS_MODAL.search(found["verbs"]):
            yield _in_obligation(
                name, False, sentence("write only the action: {action}", action=quoted(action)), action
            )


def _with_denial(name: str) -> Misreading:
    message = sentence("{name} is read as one name, including its negation", name=quoted(name))
    advice = sentence("name the action itself, for example: open the door; to forbid it, write NOT before it")
    return Misreading(NEGATION, name, message, advice)


def _either(action: str) -> str:
    """What to write for words that one reader takes for a prohibition, and another one for a permission."""
    return sentence(
        "write {action} if the robot must do it, and {text} if it must not; remove it if the robot may choose",
        action=quoted(action),
        text=quoted(f"NOT {action}"),
    )


def _in_obligation(name: str, negated: bool, help: str, instead: str | None = None) -> Misreading:
    if negated:
        message = sentence(
            "{name} is read as an obligation, although it says what the robot must not do", name=quoted(name)
        )
        return Misreading(NEGATION, name, message, help, instead)
    return Misreading(
        MODAL, name, sentence("{name} is read as one name, including the modal verb", name=quoted(name)), help, instead
    )
