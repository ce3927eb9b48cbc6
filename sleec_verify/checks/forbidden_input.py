"""Rules that forbid an input: an event that only the environment causes."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Agent, Declaration, Rule, Ruleset, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.encoding.trace_scope import responses_of, speaks_of_traces
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.wording.phrases import clause_name, listed, quoted
from sleec_verify.wording.sentence import sentence


def _forbidden_inputs(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each clause that forbids an input: an event that a declaration assigns to the environment, or that
    triggers another rule, that no rule requires and that no declaration assigns to the robot. The robot cannot prevent
    it (docs/times.md)."""
    inputs = declared_events(index.ruleset, "environment")
    if not (index.chains or speaks_of_traces(index.ruleset)):
        return
    acts = {response.name for rule in index.rules for response in responses_of(rule) if not response.negated}
    acts = (acts | declared_events(index.ruleset, "system")) - inputs
    for rule in index.rules:
        for number, clause in enumerate(rule.clauses()):
            for event in dict.fromkeys(response.name for response in literals(clause) if response.negated):
                if event == rule.trigger or event in acts:
                    continue
                triggered = [index.rules[position].label for position in index.by_trigger.get(event, ())]
                if triggered or event in inputs:
                    yield _finding(rule, number, event, triggered, event in inputs)


def declared_events(ruleset: Ruleset, agent: Agent) -> set[str]:
    """The events that declarations assign to this agent."""
    declarations = (one for one in ruleset.statements if isinstance(one, Declaration) and one.agent == agent)
    return {name for declaration in declarations for name in declaration.names}


def _finding(rule: Rule, number: int, event: str, triggered: list[str], is_declared: bool) -> Finding:
    clause = clause_name(rule, number)
    return FORBIDDEN_INPUT.finding(
        sentence("{clause} forbids {event}, which the environment causes", clause=clause, event=quoted(event))
        if is_declared
        else sentence(
            "{clause} forbids {event}, which triggers {triggered} and which no rule requires",
            clause=clause,
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
            "The rule forbids an event that is declared BY environment, or that triggers another rule and that no "
            "rule requires. Such an event comes from "
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
