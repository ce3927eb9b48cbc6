"""Constraints and relations of a mission: EXCLUSIVE, NEVER, ASSUME, and the relations of the DSL.

They constrain one instant. In a log, the executions for one trigger have different times. So the moments up to the
tolerance after a trigger, and before the next trigger, are a group: its events count as simultaneous. Conditions have
the values of their moment.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from sleec_runtime.audit.deviation import BREACHES, Deviation
from sleec_runtime.audit.domain_rules import DomainRules
from sleec_runtime.audit.moment import UNKNOWN_DOMAIN, Moment
from sleec_runtime.evaluation.formula_truth import Situation, truth, unreported
from sleec_runtime.evaluation.trace_violations import Requirement
from sleec_runtime.model import Assume, Formula, Rational, names_of


class ConstraintMonitor:
    """Decides the constraints and relations at each moment. `rules_of` gives the statements of a domain."""

    def __init__(self, tolerance: Rational, rules_of: Callable[[str | None], DomainRules]) -> None:
        self.tolerance = tolerance
        self._rules_of = rules_of
        self.group: list[Moment] = []

    def observe(self, moment: Moment) -> Iterator[Deviation]:
        """The deviations that a moment shows. Moments are in order, and `advance` was called with the time of each."""
        if moment.is_triggered and self.group and self.group[0].time != moment.time:
            yield from self.flush()
        if moment.is_triggered or self.group:
            self.group.append(moment)
        else:
            yield from self._decide(moment, (moment,))

    def advance(self, now: Rational) -> Iterator[Deviation]:
        """The deviations of a group that ends before `now`."""
        if self.group and now > self.group[0].time + self.tolerance:
            yield from self.flush()

    def flush(self, end: Rational | None = None) -> Iterator[Deviation]:
        """The deviations of the present group, which ends: each constraint and relation once. A breach takes precedence
        over what is not known. The log ends at the time `end`, if it ends within the group: events may follow."""
        group, self.group = self.group, []
        found: dict[int, Deviation] = {}
        for moment in group:
            for deviation in self._decide(moment, group, end):
                before = found.setdefault(id(deviation.statement), deviation)
                if before.kind not in BREACHES and deviation.kind in BREACHES:
                    found[id(deviation.statement)] = deviation
        yield from found.values()

    def _decide(self, moment: Moment, group: Sequence[Moment], end: Rational | None = None) -> Iterator[Deviation]:
        is_domain_known = moment.domain != UNKNOWN_DOMAIN
        rules = self._rules_of(moment.domain if is_domain_known else None)
        own = moment.occurred | moment.executed
        occurred = set().union(*(one.occurred for one in group)) if own else own
        executed = set().union(*(one.executed for one in group)) if own else own
        is_first = moment is group[0]
        names = (occurred | executed if is_first else own) | moment.changed
        for watched in rules.watched(names, moment.has_entered):
            situation = rules.situation(moment, occurred, executed, watched.formula)
            value = truth(watched.formula, situation)
            if value or (value is None and not watched.events & own):
                continue
            if watched.events and not is_first:
                others = occurred - moment.occurred, executed - moment.executed
                if truth(watched.formula, rules.situation(moment, *others, watched.formula)) is value:
                    continue  # It does not depend on what happens in this moment.
            deviation = deviation_of(watched.statement, watched.formula, moment, value, situation)
            if not is_domain_known and watched.is_of_domains:
                deviation = replace(deviation, kind="undetermined", missing=("domain",))
            elif value is False and end is not None:
                unfinished = rules.situation(moment, occurred, executed, watched.formula, is_over=False)
                if truth(watched.formula, unfinished) is None:
                    deviation = replace(deviation, kind="open", time=end)
            yield deviation


def deviation_of(
    statement: Requirement, formula: Formula, moment: Moment, value: bool | None, situation: Situation
) -> Deviation:
    """The deviation that the formula of a statement is false, or unknown."""
    conditions = moment.conditions
    return Deviation(
        "undetermined" if value is None else "assumption" if isinstance(statement, Assume) else "constraint",
        moment.time,
        statement=statement,
        conditions={name: conditions[name] for name in names_of(formula) if name in conditions},
        missing=tuple(dict.fromkeys(unreported(formula, situation))),
    )
