"""What can be seen without a solver: names that nothing uses, hedges that say nothing, words that mislead."""

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
    Never,
    Span,
    leaves,
    literals,
)
from sleec_verify.checks.base import Check, FindingKind, clause_name
from sleec_verify.encoding.name_uses import constants_used, mentions, names_used
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding


def _unused(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    used = names_used(ruleset)
    constants = constants_used(ruleset)
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
                f"a constraint names {name}, but no rule obliges or forbids it",
                span,
                kind=1,
                obligations=(name,),
                help=f"check the spelling; if {name} says how things are, and not what to do, declare it a CONDITION",
            )


def _unused_finding(kind: str, name: str, span: Span) -> Finding:
    return UNUSED_NAME.finding(
        f"the {kind} {name} is declared and never used",
        span,
        help="remove the declaration, or check the spelling where you meant to use it",
    )


def _constrained(index: RulesetIndex) -> Iterator[tuple[str, Span]]:
    """The obligations that EXCLUSIVE and NEVER name."""
    for constraint in index.constraints:
        if isinstance(constraint, Exclusive):
            yield from zip(constraint.names, constraint.name_spans)
        elif isinstance(constraint, Never):
            for leaf in leaves(constraint.formula):
                if isinstance(leaf, Atom) and leaf.kind == "obligation":
                    yield leaf.name, leaf.span


def _empty_hedges(index: RulesetIndex) -> Iterator[Finding]:
    then = "then" if index.ruleset.syntax == "dsl" else "IN WHICH CASE"
    for rule, clauses in zip(index.rules, index.clauses):
        for number, clause in enumerate(clauses):
            if number and not clause.obligations:
                yield EMPTY_HEDGE.finding(
                    f"{clause_name(rule, number)} says nothing of what to do",
                    clause.span,
                    rules=(rule.label,),
                    clauses=(ClauseRef(rule.label, number),),
                    note="where it decides, the rule obliges nothing, and its default is not executed either",
                    help=f"if that is meant, keep it; else add {then} and a response",
                )


def _two_kinds(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    # An event may be a trigger; it is one if a rule has it.
    merely_declared = ruleset.declared["event"] - {rule.trigger for rule in ruleset.rules}
    for name in sorted((ruleset.triggers - merely_declared) & ruleset.obligations):
        span, rules = mentions(ruleset, name)
        yield TRIGGER_OBLIGATION.finding(
            f"{name} is a trigger and an obligation",
            span,
            rules=rules,
            obligations=(name,),
            note="doing it triggers the rules of that name; with --no-chains it triggers nothing"
            if index.chains
            else "doing it triggers nothing here, because of --no-chains",
        )


_KEYWORDS = frozenset(("when", "then", "unless", "and", "or", "otherwise"))
_TIMES = frozenset(("within", "eventually", "else"))
"""Keywords behind an obligation; a condition with one of these words can mean nothing but itself."""
_TOLD = re.compile(rf".\b(?:before|after|in|by) [0-9]+ (?:{'|'.join(sorted(UNITS))})\b", re.IGNORECASE)
"""A time in a phrase that most likely says when it is due; `wait for 5 minutes` is something to do."""


def _lower_case_keywords(index: RulesetIndex) -> Iterator[Finding]:
    ruleset = index.ruleset
    measures = set(ruleset.measures)
    for name in sorted(ruleset.triggers | ruleset.conditions | ruleset.obligations | measures):
        words = name.split()
        # "call someone else" is fine, too: a time, or what is due instead, would follow.
        times = _TIMES if name in ruleset.obligations and words[-1].lower() not in _TIMES else frozenset[str]()
        # "the user does not answer" is fine as one condition; "not asleep" most likely is not.
        found = [w for n, w in enumerate(words) if w.lower() in _KEYWORDS | times or (n == 0 and w.lower() == "not")]
        if len(words) > 1 and found:
            span, rules = mentions(ruleset, name)
            yield PHRASE_KEYWORD.finding(
                f"\u201c{name}\u201d is read as one name, the word {found[0]} included",
                span,
                rules=rules,
                help=f"if you meant the keyword, write {found[0].upper()}",
            )
        elif name in ruleset.obligations and _TOLD.search(name):
            span, rules = mentions(ruleset, name)
            yield PHRASE_KEYWORD.finding(
                f"\u201c{name}\u201d is read as one name, the time included",
                span,
                rules=rules,
                help="if you meant when it is due, write it behind WITHIN, as in: WITHIN 5 minutes",
            )


UNUSED_NAME = Check(
    "unused-name",
    "Is every name that is declared used, and every constrained name obliged?",
    (
        FindingKind(
            "SLEEC501",
            "note",
            "a name that is declared and never used",
            "A declaration that nothing uses is either left over or a sign that a rule spells the name otherwise.",
            "Remove the declaration, or use its spelling in the rules.",
            "CONDITION UserAsleep, UserAway\nWHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE Wait\n",
            "CONDITION UserAsleep\nWHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE Wait\n",
        ),
        FindingKind(
            "SLEEC502",
            "note",
            "a constraint on something that no rule obliges",
            "An EXCLUSIVE or NEVER names an obligation that no rule obliges or forbids. It can matter only through "
            "other constraints that name it too.",
            "Usually the name is spelt otherwise in the rules: use one spelling. Otherwise remove it from the "
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
    "Does every hedge say what to do?",
    (
        FindingKind(
            "SLEEC503",
            "note",
            "a hedge that says nothing of what to do",
            "UNLESS without IN WHICH CASE lifts the rule and puts nothing in its place. That may be meant; a reader "
            "cannot tell it from something forgotten.",
            "Write what is to be done: IN WHICH CASE and a response. If nothing is, leave it, and say why in a "
            "comment.",
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
            "a name that is a trigger and an obligation",
            "The response of one rule has the name of the trigger of another. So the response triggers that rule, and "
            "`check` counts what follows. With `--no-chains` it triggers nothing.",
            "If the two are different things, give them different names. If they are the same, leave them: `explain` "
            "shows what follows.",
            "WHEN SmokeDetected THEN SoundAlarm\nWHEN SoundAlarm THEN CallOperator\n",
            "WHEN SmokeDetected THEN SoundAlarm\nWHEN AlarmHeard THEN CallOperator\n",
        ),
    ),
    _two_kinds,
    scope="text",
)

PHRASE_KEYWORD = Check(
    "phrase-keyword",
    "Does any phrase hold a keyword in lower case?",
    (
        FindingKind(
            "SLEEC505",
            "note",
            "a phrase that holds a keyword in lower case",
            "Keywords are written in capitals. In lower case the word is part of the name, so `the user is alone and "
            "asleep` is one condition, not two. So is a time without WITHIN, as in `call the nurse after 5 minutes`.",
            "If you meant the keyword, write it in capitals. If it is part of the name, join the words, as in "
            "UserAloneAndAsleep, or put it in other words.",
            "WHEN the user calls THEN answer\nUNLESS the user is alone and asleep IN WHICH CASE wait\n",
            "WHEN the user calls THEN answer\nUNLESS the user is alone AND the user is asleep IN WHICH CASE wait\n",
        ),
    ),
    _lower_case_keywords,
    scope="text",
)
