"""What rules oblige in one situation, with all that explains it: what it leads to, and until when."""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.model import Context, Ruleset
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.entailment.answer import Entailment
from sleec_verify.entailment.consequence_tree import chain
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.schedule import schedule


def explain(ruleset: Ruleset, context: Context, untimed: Untimed = "at") -> Entailment:
    """The obligations in `context`, with the consequence tree and the schedule.

    `untimed` is the meaning of a response without a window in rules with time. Raises `Undecided` as `entail` does.
    """
    answer = entail(ruleset, context, untimed=untimed)
    steps, at_odds = chain(ruleset, context, answer, untimed)
    answer = replace(answer, chain=steps, at_odds=at_odds)
    return replace(answer, schedule=schedule(ruleset, context, answer, untimed))
