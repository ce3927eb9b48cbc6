"""What a ruleset entails in one context, and why.

Without time it is Definition 1 (`sleec_verify.entailment.active_clauses`). With time, alternatives, relations or
chains, it is what all complying responses have in common (`sleec_verify.entailment.over_time`).
"""

from __future__ import annotations

from sleec_runtime.model import Context, Ruleset
from sleec_verify.encoding.trace_scope import Untimed, has_chains, speaks_of_traces
from sleec_verify.entailment.active_clauses import active_clauses
from sleec_verify.entailment.answer import Entailment


def entail(ruleset: Ruleset, context: Context, domain: str | None = None, untimed: Untimed = "at") -> Entailment:
    """What `ruleset` entails in `context`, in `domain` if one is given.

    Only the rules that the triggers can lead to are encoded. `untimed` is the meaning of a response without a window in
    rules with time. Raises `Undecided` if the solver cannot decide within its budget whether the constraints allow what
    is due.
    """
    if domain is not None:
        ruleset = ruleset.in_domain(domain)
    answer = active_clauses(ruleset, context)
    if not (speaks_of_traces(ruleset) or has_chains(ruleset)):
        return answer
    # Imported only for rules with time, because it is slow.
    from sleec_verify.entailment.over_time import over_time

    return over_time(ruleset, context, answer, untimed)
