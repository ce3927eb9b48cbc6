"""Rules that require an input: an event that a declaration assigns to the environment."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Rule, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.forbidden_input import declared_events
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.wording.phrases import clause_name, quoted
from sleec_verify.wording.sentence import sentence


def _required_inputs(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each clause, and each event of the environment that it requires, at any depth of its response. The
    robot cannot cause it (docs/times.md)."""
    inputs = declared_events(index.ruleset, "environment")
    if not inputs:
        return
    for rule in index.rules:
        for number, clause in enumerate(rule.clauses()):
            for event in dict.fromkeys(response.name for response in literals(clause) if not response.negated):
                if event in inputs:
                    yield _finding(rule, number, event)


def _finding(rule: Rule, number: int, event: str) -> Finding:
    return REQUIRED_INPUT.finding(
        sentence(
            "{clause} requires {event}, which the environment causes",
            clause=clause_name(rule, number),
            event=quoted(event),
        ),
        list(rule.clauses())[number].span,
        rules=(rule.label,),
        clauses=(ClauseRef(rule.label, number),),
        obligations=(event,),
        note=sentence("its declaration assigns it to the environment, so the robot cannot make it occur"),
        help=sentence("require an action of the robot instead, or declare the event BY system if the robot causes it"),
    )


REQUIRED_INPUT = Check(
    "required-input",
    "Does every rule require only actions of the robot?",
    (
        FindingKind(
            "SLEEC108",
            "warning",
            "a rule that requires an input",
            "The rule requires an event that is declared BY environment: a person answers, a door closes by itself. "
            "The robot does not cause such an event, so whether the rule is followed depends on others.",
            "Require an action of the robot instead, such as a question or a request. If the robot causes the event, "
            "declare it BY system.",
            "EVENT UserFalls\nEVENT UserAnswers BY environment\nRULE fall\nWHEN UserFalls THEN UserAnswers\n",
            "EVENT UserFalls\nEVENT AskUser BY system\nRULE fall\nWHEN UserFalls THEN AskUser\n",
        ),
    ),
    _required_inputs,
)
