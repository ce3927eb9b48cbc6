"""Rules and clauses as the titles of repairs name them.

A change of an ALWAYS statement changes all its rules, so a title quotes the statement instead of the label of one rule.
"""

from __future__ import annotations

from sleec_runtime.model import Rule, Ruleset, Span
from sleec_verify.wording.phrases import exception, quoted
from sleec_verify.wording.sentence import sentence


def rule_name(ruleset: Ruleset, rule: Rule) -> str:
    """``rule `air` ``, or `` `ALWAYS be polite` ``."""
    if rule.always is None:
        return sentence("rule {rule}", rule=quoted(rule.label))
    return always_statement(ruleset, rule)


def always_statement(ruleset: Ruleset, rule: Rule) -> str:
    """The ALWAYS statement of a rule without its exceptions, quoted, on one line."""
    end = rule.hedges[0].span.start if rule.hedges else rule.span.end
    return quoted(ruleset.source.in_one_line(Span(rule.span.start, end)))


def clause_name(ruleset: Ruleset, rule: Rule, number: int) -> str:
    """``rule `air` ``, or ``the exception `UNLESS c` of rule `air` `` for a clause that is not the default."""
    name = rule_name(ruleset, rule)
    return (
        sentence("{exception} of {rule}", exception=exception(list(rule.clauses())[number]), rule=name)
        if number
        else name
    )
