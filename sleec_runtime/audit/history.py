"""Relations about several instants: ``happenBefore``, ``when … until`` and ``when … for``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from sleec_runtime.audit.constraints import deviation_of
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.domain_rules import DomainRules
from sleec_runtime.audit.duty import within_reach
from sleec_runtime.audit.moment import Moment
from sleec_runtime.evaluation.formula_truth import truth
from sleec_runtime.evaluation.instant_formulas import conjunction, occurrence
from sleec_runtime.model import Formula, Lasting, Or, Rational, Truth, exact


@dataclass
class Span:
    """The time in which a relation ``when … until`` or ``when … for`` applies: from `begin`, to before `over`."""

    relation: Lasting
    begin: Rational
    over: Rational | None
    is_unknown: bool = False


class HistoryMonitor:
    """Decides the relations about several instants at each moment. `rules_of` gives the statements of a domain.

    Of the spans of one relation, the one that ends last is watched, because it covers the others.
    """

    def __init__(self, rules_of: Callable[[str | None], DomainRules]) -> None:
        self._rules_of = rules_of
        self.is_late = False
        """Whether events may have occurred before the first moment."""
        self.first: dict[str, Rational] = {}
        self.spans: list[Span] = []

    def observe(self, moment: Moment) -> Iterator[Deviation]:
        """The deviations that a moment shows. Moments are in order."""
        rules = self._rules_of(moment.domain)
        for relation in rules.before:
            if relation.right in moment.occurred and not self._was_before(relation.left, moment.time):
                if self.is_late:
                    yield Deviation("undetermined", moment.time, statement=relation, missing=(relation.left,))
                else:
                    yield Deviation("constraint", moment.time, statement=relation)
            if relation.left in moment.occurred:
                self.first.setdefault(relation.left, moment.time)
        for lasting in rules.lasting:
            if lasting.event in moment.occurred:
                yield from self._begin(lasting, rules, moment)
        self.spans = [span for span in self.spans if span.over is None or moment.time < span.over]
        for span in tuple(self.spans):
            yield from self._watch(span, rules, moment)

    def _was_before(self, event: str, time: Rational) -> bool:
        return event in self.first and self.first[event] < time

    def _begin(self, relation: Lasting, rules: DomainRules, moment: Moment) -> Iterator[Deviation]:
        condition = relation.condition or Truth(True)
        situation = rules.situation(moment, moment.occurred, moment.executed, condition)
        held = truth(condition, situation)
        over: Rational | None = None
        missing: list[str] = []
        if relation.duration is not None and held is not False:
            values = {name: exact(moment.conditions.get(name)) for name in relation.duration.measures}
            known = {name: value for name, value in values.items() if value is not None}
            missing = [name for name in values if name not in known]
            over = moment.time if missing else moment.time + within_reach(relation.duration.seconds_where(known))
        if held is None or missing:
            found = deviation_of(relation, condition, moment, None, situation)
            yield replace(found, missing=(*found.missing, *missing))
        elif held:
            earlier = next((span for span in self.spans if span.relation is relation), None)
            if earlier is None:
                self.spans.append(Span(relation, moment.time, over))
            elif over is not None and earlier.over is not None and over > earlier.over:
                earlier.begin, earlier.over = moment.time, over

    def _watch(self, span: Span, rules: DomainRules, moment: Moment) -> Iterator[Deviation]:
        relation = span.relation
        end: Formula = Truth(False)
        if relation.end is not None:
            end = conjunction(occurrence(relation.end), relation.end_condition)
        formula = Or((relation.formula, end))
        situation = rules.situation(moment, moment.occurred, moment.executed, formula)
        value = truth(formula, situation)
        if truth(end, situation) or value is False:
            self.spans.remove(span)
        if value is False or (value is None and not span.is_unknown):
            span.is_unknown = value is None
            found = deviation_of(relation, formula, moment, value, situation)
            yield replace(found, first=span.begin, last=span.over)
