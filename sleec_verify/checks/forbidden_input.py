"""Rules that forbid an input: an event that only the environment causes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

from sleec_runtime.model import Declaration, Rule, Statement, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.encoding.trace_scope import responses_of, speaks_of_traces
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.wording.phrases import clause_name, listed, quoted
from sleec_verify.wording.sentence import sentence


def _forbidden_inputs(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each clause that forbids an input: an event that triggers another rule, that no rule requires and
    that no declaration assigns to the robot. The robot cannot prevent it (docs/times.md)."""
    if not (index.chains or speaks_of_traces(index.ruleset)):
        return
    acts = {name for one in index.ruleset.statements if _is_the_robots(one) for name in one.names}
    acts |= {response.name for rule in index.rules for response in responses_of(rule) if not response.negated}
    for rule in index.rules:
        for number, clause in enumerate(rule.clauses()):
            for event in dict.fromkeys(response.name for response in literals(clause) if response.negated):
                if event == rule.trigger or event in acts:
                    continue
                triggered = [index.rules[position].label for position in index.by_trigger.get(event, ())]
                if triggered:
                    yield _finding(rule, number, event, triggered)


def _is_the_robots(statement: Statement) -> TypeGuard[Declaration]:
    return isinstance(statement, Declaration) and statement.agent == "system"


def _finding(rule: Rule, number: int, event: str, triggered: list[str]) -> Finding:
    return FORBIDDEN_INPUT.finding(
        sentence(
            "{clause} forbids {event}, which triggers {triggered} and which no rule requires",
            clause=clause_name(rule, number),
            event=quoted(event),
            triggered=listed(map(quoted, triggered)),
        ),
        list(rule.clauses())[number].span,
        rules=(rule.label, *triggered),
        clauses=(ClauseRef(rule.label, number),),
        obligations=(event,),
        note=sentence("such an event comes from the environment, and the robot cannot prevent it"),
        help=sentence("forbid an action of the robot instead, or state with ASSUME that the event does not occur then"),
    )


FORBIDDEN_INPUT = Check(
    "forbidden-input",
    "Does every prohibition forbid an action of the robot?",
    (
        FindingKind(
            "SLEEC107",
            "warning",
            "a rule that forbids an input",
            "The rule forbids an event that triggers another rule and that no rule requires. Such an event comes from "
            "the environment: a person calls, an alarm rings. The robot cannot prevent it, so it cannot follow the "
            "rule.",
            "Forbid an action of the robot instead, or state with ASSUME that the event does not occur then. If the "
            "robot causes the event, and the text declares its names, write EVENT … BY system.",
            "RULE rest\nWHEN UserSleeps THEN NOT DoorbellRings WITHIN 1 hour\n"
            "RULE door\nWHEN DoorbellRings THEN OpenDoor\n",
            "RULE rest\nWHEN UserSleeps THEN NOT RingDoorbell WITHIN 1 hour\n"
            "RULE door\nWHEN DoorbellRings THEN OpenDoor\n",
        ),
    ),
    _forbidden_inputs,
)
