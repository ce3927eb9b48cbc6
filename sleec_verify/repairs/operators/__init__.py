"""The operators that propose repairs, by the code of the finding."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from sleec_runtime.model import Ruleset
from sleec_verify.checks.misread_names import MISREAD_NAME
from sleec_verify.repairs.operators.assumptions import assumptions
from sleec_verify.repairs.operators.bounds import bounds, operators
from sleec_verify.repairs.operators.chains import readings, silences
from sleec_verify.repairs.operators.concerns import preventions
from sleec_verify.repairs.operators.corrections import constrained, definitions, events, labels, values, windows
from sleec_verify.repairs.operators.deadlines import deadlines
from sleec_verify.repairs.operators.decomposition import decompositions
from sleec_verify.repairs.operators.giving_way import exceptions, guards, refinements, responses
from sleec_verify.repairs.operators.inputs import agents
from sleec_verify.repairs.operators.nevers import nevers
from sleec_verify.repairs.operators.purposes import relaxations
from sleec_verify.repairs.operators.removal import declarations, hedges, redundant_rule, rules
from sleec_verify.repairs.operators.reordering import orders
from sleec_verify.repairs.operators.wording import names
from sleec_verify.repairs.repair import Candidate
from sleec_verify.results.finding import Finding

Operation = Callable[[Ruleset, Finding], Iterator[Candidate]]
"""Proposes candidates for a finding. They need not be repairs. Raises `Unsayable` if the language has no words for
one."""

_WHO_GIVES_WAY: tuple[Operation, ...] = (
    bounds,
    guards,
    exceptions,
    refinements,
    orders,
    responses,
    decompositions,
    deadlines,
    assumptions,
    hedges,
    nevers,
    rules,
)

REMOVALS: Mapping[str, Operation] = {
    "SLEEC202": hedges,
    "SLEEC301": redundant_rule,
    "SLEEC302": hedges,
    "SLEEC501": declarations,
    "SLEEC509": redundant_rule,
}
"""Removal of what has no effect."""

CONSEQUENCES: Mapping[str, Operation] = {**REMOVALS, "SLEEC107": agents}
"""What a change may make necessary: if no rule requires an act any more, its declaration says that it is one."""

OPERATORS: Mapping[str, tuple[Operation, ...]] = {
    "SLEEC101": _WHO_GIVES_WAY,
    "SLEEC102": _WHO_GIVES_WAY,
    "SLEEC104": (preventions,),
    "SLEEC105": (relaxations, rules),
    "SLEEC107": (agents, responses, hedges, redundant_rule),
    "SLEEC108": (responses, hedges, redundant_rule),
    **{code: (removal,) for code, removal in REMOVALS.items()},
    "SLEEC201": (operators, rules),
    "SLEEC202": (orders, hedges, operators),
    "SLEEC401": (readings,),
    "SLEEC502": (constrained,),
    "SLEEC503": (silences,),
    "SLEEC506": (labels,),
    "SLEEC507": (values,),
    "SLEEC508": (values,),
    "SLEEC510": (preventions, events),
    "SLEEC512": (operators,),
    "SLEEC513": (windows,),
    "SLEEC519": (definitions,),
    **{kind.code: (names,) for kind in MISREAD_NAME.kinds},
}
