"""Checks of the text without a solver: unused names, hedges without a response, misleading words."""

from __future__ import annotations

import re
from collections.abc import Iterator

from sleec_runtime.language.common.units import UNITS
from sleec_runtime.model import (
    Atom,
    Constant,
    Declaration,
    Exclusive,
    Measure,
    Span,
    leaves,
    literals,
)
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.encoding.name_uses import constants_used, mentions
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.wording.phrases import clause_name, kind_words, quoted
from sleec_verify.wording.sentence import sentence


def _unused(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    used = index.names_used
    constants = constants_used(ruleset) if ruleset.constants else set[str]()
    for statement in ruleset.statements:
        if isinstance(statement, Declaration):
            for name, span in zip(statement.names, statement.name_spans):
                if name not in used[statement.kind]:
                    yield _unused_finding(statement.kind, name, span)
        elif isinstance(statement, Measure) and statement.name not in used["condition"]:
            yield _unused_finding("measure", statement.name, statement.span)
        elif isinstance(statement, Constant) and statement.name not in constants:
            yield _unused_finding("constant", statement.name, statement.span)
    obliged = {o.name for clauses in index.clauses for clause in clauses for o in literals(clause)}
    for name, span in _constrained(index):
        if name not in obliged:
            yield UNUSED_NAME.finding(
                sentence("a constraint names {name}, but no rule requires or forbids it", name=quoted(name)),
                span,
                kind=1,
                obligations=(name,),
                help=sentence(
                    "check the spelling; if {name} is a fact and not an action, declare it as a CONDITION",
                    name=quoted(name),
                ),
            )


def _unused_finding(kind: str, name: str, span: Span) -> Finding:
    return UNUSED_NAME.finding(
        sentence("the {kind} {name} is declared but never used", kind=kind_words(kind), name=quoted(name)),
        span,
        help=sentence("remove the declaration, or check the spelling of the name in the rules"),
    )


def _constrained(index: RulesetIndex) -> Iterator[tuple[str, Span]]:
    """The obligations that EXCLUSIVE and NEVER name, except those that NEVER forbids alone: no rule needs them."""
    for constraint in index.constraints:
        if isinstance(constraint, Exclusive):
            yield from zip(constraint.names, constraint.name_spans)
        elif not isinstance(constraint.forbidden, Atom):
            for leaf in leaves(constraint.formula):
                if isinstance(leaf, Atom) and leaf.kind == "obligation":
                    yield leaf.name, leaf.span


def _empty_hedges(index: RulesetIndex) -> Iterator[Finding]:
    then = "then" if index.ruleset.syntax == "dsl" else "IN WHICH CASE"
    for rule, clauses in zip(index.rules, index.clauses):
        for number, clause in enumerate(clauses):
            if number and not clause.obligations:
                yield EMPTY_HEDGE.finding(
                    sentence("{clause} does not say what to do", clause=clause_name(rule, number)),
                    clause.span,
                    rules=(rule.label,),
                    clauses=(ClauseRef(rule.label, number),),
                    note=sentence("when it applies, the rule requires nothing, not even its default response"),
                    help=sentence("add {then} and a response; if the rule should require nothing, keep it", then=then),
                )


def _two_kinds(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    # An event may be a trigger; it is one if a rule has it.
    merely_declared = ruleset.declared["event"] - {rule.trigger for rule in ruleset.rules}
    for name in sorted((ruleset.triggers - merely_declared) & ruleset.obligations):
        span, rules = mentions(ruleset, name)
        yield TRIGGER_OBLIGATION.finding(
            sentence("{name} is both a trigger and an obligation", name=quoted(name)),
            span,
            rules=rules,
            obligations=(name,),
            note=sentence("when the robot does it, the rules with this trigger apply; with --no-chains they do not")
            if index.chains
            else sentence("when the robot does it, no rule applies because of --no-chains"),
        )


_KEYWORDS = frozenset(("when", "then", "unless", "and", "or", "otherwise"))
_TIMES = frozenset(("within", "eventually", "else"))
"""Keywords that follow an obligation. In a condition, these words are part of the name."""
_TOLD = re.compile(rf".\b(?:before|after|in|by) [0-9]+ (?:{'|'.join(sorted(UNITS))})\b", re.IGNORECASE)
"""A time in a phrase that is probably a time limit. `wait for 5 minutes` is an action."""


def _lower_case_keywords(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    names = ruleset.triggers | ruleset.conditions | ruleset.obligations | ruleset.measures.keys()
    for name in sorted(name for name in names if " " in name):
        words = name.split()
        # "call someone else" is fine, too: a time, or what is due instead, would follow.
        times = _TIMES if name in ruleset.obligations and words[-1].lower() not in _TIMES else frozenset[str]()
        found = [word for word in words if word.lower() in _KEYWORDS | times]
        if found:
            span, rules = mentions(ruleset, name)
            yield PHRASE_KEYWORD.finding(
                sentence(
                    "{name} is read as one name, including the word {word}", name=quoted(name), word=quoted(found[0])
                ),
                span,
                rules=rules,
                help=sentence("if you mean the keyword, write {word}", word=found[0].upper()),
            )
        elif name in ruleset.obligations and _TOLD.search(name):
            span, rules = mentions(ruleset, name)
            yield PHRASE_KEYWORD.finding(
                sentence("{name} is read as one name, including the time", name=quoted(name)),
                span,
                rules=rules,
                help=sentence("if you mean a time limit, use WITHIN, for example: WITHIN 5 minutes"),
            )


UNUSED_NAME = Check(
    "unused-name",
    "Is every declared name used, and every constrained name required or forbidden?",
    (
        FindingKind(
            "SLEEC501",
            "note",
            "a name that is declared but never used",
            "Either the declaration is superfluous, or a rule spells the name differently.",
            "Remove the declaration, or use its spelling in the rules.",
            "CONDITION UserAsleep, UserAway\nWHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE Wait\n",
            "CONDITION UserAsleep\nWHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE Wait\n",
        ),
        FindingKind(
            "SLEEC502",
            "note",
            "a constraint on something that no rule requires or forbids",
            "An EXCLUSIVE or NEVER names an obligation that no rule requires or forbids. It has an effect only if "
            "another constraint names the obligation, too.",
            "Usually the rules spell the name differently: use one spelling. Otherwise remove the name from the "
            "constraint.",
            "EXCLUSIVE Answer, StayQuiet\nWHEN UserCalls THEN Answer\nWHEN UserSleeps THEN StaySilent\n",
            "EXCLUSIVE Answer, StaySilent\nASSUME NOT (UserCalls AND UserSleeps)\n"
            "WHEN UserCalls THEN Answer\nWHEN UserSleeps THEN StaySilent\n",
        ),
    ),
    _unused,
    scope="text",
)

EMPTY_HEDGE = Check(
    "empty-hedge",
    "Does every exception say what to do?",
    (
        FindingKind(
            "SLEEC503",
            "note",
            "an exception that does not say what to do",
            "UNLESS without IN WHICH CASE cancels the rule and requires nothing instead. Readers cannot tell whether "
            "the response was forgotten.",
            "Add IN WHICH CASE and a response. If nothing should be done, keep the exception and say why in a comment.",
            "WHEN UserCalls THEN Answer\nUNLESS UserAsleep\n",
            "WHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE WaitUntilAwake\n",
        ),
    ),
    _empty_hedges,
    scope="text",
)

TRIGGER_OBLIGATION = Check(
    "trigger-obligation",
    "Is any name both a trigger and an obligation?",
    (
        FindingKind(
            "SLEEC504",
            "note",
            "a name that is both a trigger and an obligation",
            "The response of one rule is the trigger of another rule. So the response triggers that rule, and `check` "
            "includes the consequences. With `--no-chains` it triggers nothing.",
            "If they are two different things, use two names. If they are the same, keep them: `explain` shows the "
            "consequences.",
            "WHEN SmokeDetected THEN SoundAlarm\nWHEN SoundAlarm THEN CallOperator\n",
            "WHEN SmokeDetected THEN SoundAlarm\nWHEN AlarmHeard THEN CallOperator\n",
        ),
    ),
    _two_kinds,
    scope="text",
)

PHRASE_KEYWORD = Check(
    "phrase-keyword",
    "Does a phrase contain a keyword in lower case?",
    (
        FindingKind(
            "SLEEC505",
            "note",
            "a phrase that contains a keyword in lower case",
            "Keywords are written in capitals. In lower case, the word is part of the name: `the user is alone and "
            "asleep` is one condition, not two. A time without WITHIN is also part of the name, as in `call the nurse "
            "after 5 minutes`.",
            "If you mean the keyword, write it in capitals. If the word is part of the name, join the words, as in "
            "UserAloneAndAsleep, or use other words.",
            "WHEN the user calls THEN answer\nUNLESS the user is alone and asleep IN WHICH CASE wait\n",
            "WHEN the user calls THEN answer\nUNLESS the user is alone AND the user is asleep IN WHICH CASE wait\n",
        ),
    ),
    _lower_case_keywords,
    scope="text",
)
