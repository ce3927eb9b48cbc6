"""Repairs of a concern that can happen although every rule is followed.

A concern says that some occurrence of an event, under a condition, has a response. Its negation is a rule: every such
occurrence has the opposite response. This is the operator *new rule from a concern* of SLEEC-PATCH (2026).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import Claim, Obligation, Rule, Ruleset, claims
from sleec_verify.repairs.clause_names import clause_name, rule_name
from sleec_verify.repairs.edit import TextEdit, joined
from sleec_verify.repairs.operators.claim_cases import giving_way, where
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import exception_text, with_exception
from sleec_verify.repairs.statement_insertion import new_label, rule_text, with_rule_after
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence


def preventions(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A shorter window, an exception, or a new rule, so that the concern cannot happen."""
    for concern in claims(ruleset, "concern"):
        if concern.label in finding.obligations:
            for opposite in _opposites(concern):
                yield from _shorter_windows(ruleset, concern, opposite)
                yield from _exceptions(ruleset, concern, opposite)
                yield from _rules(ruleset, concern, opposite)


def _opposites(concern: Claim) -> Iterator[Obligation]:
    """Responses that are met exactly if one of the concern is not. A concern with several needs all of them, so each
    opposite prevents it. A response with alternatives or exceptions has none."""
    for response in concern.responses:
        first, *others = response.obligations
        is_simple = first.timing is None or not any(True for _ in first.timing.alternatives())
        if is_simple and not others and not response.hedges:
            yield replace(first, negated=not first.negated)


def _shorter_windows(ruleset: Ruleset, concern: Claim, opposite: Obligation) -> Iterator[Candidate]:
    """Deadline refinement: a rule with the trigger of the concern requires the response in the time of the concern."""
    wanted = opposite.timing.window if opposite.timing is not None else None
    if wanted is None or opposite.negated:
        return
    text = ruleset.source.text[slice(*wanted.span)]
    for rule, number in _clauses(ruleset, opposite):
        if rule.trigger != concern.event:
            continue
        for own in list(rule.clauses())[number].obligations:
            window = own.timing.window if own.timing is not None else None
            if own.name == opposite.name and window is not None and window != wanted:
                title = sentence(
                    "require {action} {window} in {clause}",
                    action=quoted(own.name),
                    window=quoted(text),
                    clause=clause_name(ruleset, rule, number),
                )
                yield Candidate("deadline-refinement", title, (TextEdit(*window.span, text),))


def _exceptions(ruleset: Ruleset, concern: Claim, opposite: Obligation) -> Iterator[Candidate]:
    """Defeater introduction: a clause with the trigger of the concern that requires its response has an exception."""
    for rule, number in _clauses(ruleset, _contrary(opposite)):
        condition = where(ruleset, rule, number, concern)
        if rule.trigger == concern.event and condition is not None:
            text = quoted(exception_text(ruleset, condition, [opposite]))
            title = sentence("add to {clause}: {text}", clause=clause_name(ruleset, rule, number), text=text)
            edits = with_exception(ruleset, rule, list(rule.clauses())[number], condition, [opposite])
            yield Candidate("defeater-introduction", title, edits)


def _rules(ruleset: Ruleset, concern: Claim, opposite: Obligation) -> Iterator[Candidate]:
    """The rule that says the opposite of the concern; and this rule with exceptions or guards in the rules that
    contradict it."""
    label = new_label(ruleset, f"{concern.label}_rule")
    lines = rule_text(ruleset, label, concern.event, concern.condition, opposite)
    edits = with_rule_after(ruleset, ruleset.rules[-1], lines)
    title = sentence("add the rule {rule}", rule=quoted(" ".join(lines)))
    yield Candidate("rule-addition", title, edits)
    contrary = [one for one in _clauses(ruleset, _contrary(opposite)) if not _may_wait(one, opposite)]
    if len({rule.label for rule, _ in contrary}) < len(contrary):
        return
    for how, response in ((sentence("a condition"), None), (sentence("an exception"), opposite)):
        changed = [giving_way(ruleset, rule, number, concern, response) for rule, number in contrary]
        if changed and all(changed):
            names = listed(rule_name(ruleset, rule) for rule, _ in contrary)
            yield Candidate(
                "rule-addition",
                sentence("{title}; then add {how} to {names} for this case", title=title, how=how, names=names),
                joined((*(edit for one in changed for edit in one), *edits)),
            )


def _contrary(opposite: Obligation) -> Obligation:
    return replace(opposite, negated=not opposite.negated)


def _may_wait(clause: tuple[Rule, int], opposite: Obligation) -> bool:
    """Whether a clause requires the response at some time from the trigger on, so that a prohibition that ends does
    not contradict it."""
    rule, number = clause
    windows = [
        one.timing.window if one.timing is not None else None
        for one in list(rule.clauses())[number].obligations
        if one.name == opposite.name and not one.negated
    ]
    return bool(windows) and all(window is not None and window.end is None for window in windows)


def _clauses(ruleset: Ruleset, response: Obligation) -> Iterator[tuple[Rule, int]]:
    """The clauses that require, or forbid, what `response` does, at whatever time."""
    for rule in ruleset.rules:
        for number, clause in enumerate(rule.clauses()):
            if any(one.name == response.name and one.negated == response.negated for one in clause.obligations):
                yield rule, number
