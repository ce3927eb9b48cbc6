"""Rules with the same trigger, guard and clauses as an earlier rule."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Rule
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def _duplicates(index: RulesetIndex) -> Iterator[Finding]:
    seen: dict[object, list[Rule]] = {}
    for rule in index.rules:
        alike = seen.setdefault((rule.trigger, rule.guard, rule.default, rule.hedges), [])
        first = next((other for other in alike if _share_a_domain(rule, other)), None)
        alike.append(rule)
        if first is None:
            continue
        where = first.heading_span
        yield DUPLICATE_RULE.finding(
            sentence("rule {rule} says the same as rule {first}", rule=quoted(rule.label), first=quoted(first.label)),
            rule.heading_span,
            rules=(rule.label, first.label),
            help=sentence("remove one of them, or correct the one that should say something else"),
            related=((where, sentence("the same rule")),),
        )


def _share_a_domain(one: Rule, other: Rule) -> bool:
    if one.domains is None or other.domains is None:
        return True
    return not set(one.domains).isdisjoint(other.domains)


DUPLICATE_RULE = Check(
    "duplicate-rule",
    "Does every rule differ from the others?",
    (
        FindingKind(
            "SLEEC509",
            "warning",
            "a rule that says the same as another rule",
            "Two rules with different labels have the same trigger, condition, response and exceptions. One of them "
            "is superfluous, or is a copy that was never changed.",
            "Remove one of them, or change the copy to what it should say.",
            "RULE greet\nWHEN UserEnters THEN Greet\nRULE welcome\nWHEN UserEnters THEN Greet\n",
            "RULE greet\nWHEN UserEnters THEN Greet\nRULE welcome\nWHEN UserEnters THEN OfferSeat\n",
        ),
    ),
    _duplicates,
    scope="text",
)
