"""Compares a variant with its clause: it must execute exactly the obligations, in order and on every path."""

from __future__ import annotations

from sleec_runtime.dispatch.implementations import snake_case
from sleec_runtime.model import Obligation, Rule
from sleec_verify.conformance.structure.execution import Call, Execution
from sleec_verify.conformance.structure.methods import Variant
from sleec_verify.conformance.structure.report import Findings, clause_name
from sleec_verify.results.finding import ClauseRef
from sleec_verify.wording.phrases import listed


def compare(findings: Findings, rule: Rule, number: int, variant: Variant, trace: Execution) -> None:
    """Reports every difference between what a variant does and what clause `number` of its rule obliges."""
    clause = tuple(rule.clauses())[number]
    due = [literal.name for literal in clause.obligations if not literal.negated]
    prohibited = {literal.name for literal in clause.obligations if literal.negated and not _opens_later(literal)}
    reference = ClauseRef(rule.label, number)
    where = clause_name(rule, number)
    note = findings.obliged(rule, number)
    for node, file in trace.proceeds:
        findings.add(
            "proceed",
            f"proceed() in a variant of {where} also runs the base",
            (file, node),
            clause=reference,
            note=note,
            help="call the implementations of the obligations of the clause",
        )
    for trigger, at_node, file in trace.triggers:
        if trigger == rule.trigger:
            findings.add(
                "endless-trigger",
                f"this triggers {trigger} again in the same context, and so the same variant, without end",
                (file, at_node),
                clause=reference,
                note=note,
                help="update() the context first, or trigger it after this variant has finished",
            )
    for doubt in trace.doubts:
        findings.undecided(doubt.file, doubt.node, doubt.why)
    left = list(due)
    if len(set(due)) < len(due) and sorted(trace.executed) != sorted(due):
        left = list(dict.fromkeys(due))  # named twice, and executed once
    in_order: list[Call] = []
    for call in trace.calls:
        name = call.obligation
        at = (call.file, call.node)
        if name in prohibited:
            message = f"{name} is executed, but {where} forbids it"
            findings.add("prohibited-obligation", message, at, clause=reference, obligations=(name,), note=note)
        elif name not in due:
            message = f"{name} is executed, but {where} does not require it"
            findings.add("extra-obligation", message, at, clause=reference, obligations=(name,), note=note)
        elif name not in left:
            message = f"{name} is executed once more than {where} requires"
            findings.add("extra-obligation", message, at, clause=reference, obligations=(name,), note=note)
        else:
            left.remove(name)
            in_order.append(call)
            if call.why is not None:
                findings.add(
                    "conditional-obligation",
                    f"{name} may not be executed just once: its call is {call.why}",
                    at,
                    clause=reference,
                    obligations=(name,),
                    note=note,
                    help="call it unconditionally; conditions belong in the rule",
                )
    _order(findings, rule, number, in_order, due)
    if left and not trace.doubts:
        unfollowed = ", ".join(dict.fromkeys(trace.unfollowed))
        findings.add(
            "missing-obligation",
            f"{listed(left)} {'is' if len(left) == 1 else 'are'} not executed, but {where} requires "
            f"{'it' if len(left) == 1 else 'them'}",
            (variant.function.file, variant.function.node),
            clause=reference,
            obligations=tuple(left),
            note=note,
            help=f"if {unfollowed} executes it, use the folder with its code as the target"
            if unfollowed
            else f"call {listed(f'{snake_case(name)}()' for name in left)}",
        )


def _opens_later(prohibition: Obligation) -> bool:
    """Whether a prohibition does not hold yet when the variant runs."""
    timing = prohibition.timing
    return timing is not None and timing.window is not None and timing.window.start is not None


def _order(findings: Findings, rule: Rule, number: int, calls: list[Call], due: list[str]) -> None:
    places = [due.index(call.obligation) for call in calls]
    for before, after, call in zip(places, places[1:], calls[1:]):
        if after < before:
            findings.add(
                "obligation-order",
                f"{call.obligation} is executed after {due[before]}, but before it in {clause_name(rule, number)}",
                (call.file, call.node),
                clause=ClauseRef(rule.label, number),
                obligations=(call.obligation, due[before]),
                note=findings.obliged(rule, number),
                help="swap the calls, or the obligations in the rule",
            )
            return
