"""Rules that give way where a concern or purpose applies."""

from __future__ import annotations

from sleec_runtime.model import Atom, Claim, Formula, Obligation, Rule, Ruleset
from sleec_verify.encoding.equation import conjunction
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.operators.conditions import conjuncts, deciding, unless
from sleec_verify.repairs.statement_edits import strengthened, with_exception


def giving_way(
    ruleset: Ruleset, rule: Rule, number: int, claim: Claim, response: Obligation | None = None
) -> tuple[TextEdit, ...]:
    """The rule with an exception that has this response where the claim applies; without a response, with a guard. No
    edit if the claim always applies."""
    condition = where(ruleset, rule, number, claim)
    if condition is None:
        return ()
    if response is not None:
        return with_exception(ruleset, rule, list(rule.clauses())[number], condition, [response])
    return strengthened(ruleset, rule, unless(ruleset, rule, number, condition))


def where(ruleset: Ruleset, rule: Rule, number: int, claim: Claim) -> Formula | None:
    """The condition under which the claim applies where a clause decides; None if it always does.

    A check of rules with time cannot decide a condition that names a response. So it leaves out such an event.
    """
    own = {Atom("trigger", rule.trigger), *deciding(ruleset, rule, number)}
    applies = conjuncts(claim.condition) if claim.condition is not None else ()
    if not applies or claim.event not in ruleset.obligations:
        applies = (Atom("trigger", claim.event), *applies)
    needed = [part for part in applies if part not in own]
    return conjunction(needed) if needed else None
