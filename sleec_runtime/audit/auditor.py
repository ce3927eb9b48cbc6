"""The auditor: it compares what a mission executes with what the rules require, observation by observation."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from sleec_runtime.audit.constraints import ConstraintMonitor
from sleec_runtime.audit.coverage import Coverage
from sleec_runtime.audit.deviation import Deviation, DeviationKind, Triggered
from sleec_runtime.audit.domain_rules import DomainRules
from sleec_runtime.audit.duty import Due, Duty, DutyMaker
from sleec_runtime.audit.history import HistoryMonitor
from sleec_runtime.audit.moment import UNKNOWN_DOMAIN, Moment
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, Reported
from sleec_runtime.audit.open_duties import OpenDuties
from sleec_runtime.audit.permissions import Permissions
from sleec_runtime.audit.response_times import ResponseTimes
from sleec_runtime.audit.vocabulary import Vocabulary
from sleec_runtime.errors import UnknownDomain, WrongType
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Decision, walk
from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.model import LONGEST, Rational, Rule, Ruleset, Value, exact, fit

TOLERANCE = 1
"""The default tolerance in seconds."""


class Auditor:
    """Audits one mission. It stores only open duties and relations, so a mission can be of any length.

    `domain` is the domain at the beginning; without one, all rules apply. `tolerance` is in seconds: an obligation may
    be executed this much later than its window allows, because a log has delays. `untimed` is the meaning of a
    response without a window in rules with time. With `chains`, an executed obligation is also an event that triggers
    rules.

    `coverage` and `response_times` count what was observed. `on_duty` is called with each duty when it begins; the duty
    changes until it is settled. Raises UnknownDomain and WrongType.
    """

    def __init__(
        self,
        ruleset: Ruleset,
        *,
        domain: str | None = None,
        tolerance: Rational | float = TOLERANCE,
        untimed: Untimed = "at",
        chains: bool = True,
    ) -> None:
        seconds = exact(tolerance)
        if seconds is None or not 0 <= seconds <= LONGEST:
            raise WrongType("tolerance", tolerance, f"a number of seconds, from 0 to {LONGEST:,}")
        if domain is not None and ruleset.domains and domain not in ruleset.domains:
            raise UnknownDomain(domain, ruleset.domains)
        self.ruleset = ruleset
        self.tolerance = seconds
        self.chains = chains
        self.on_duty: Callable[[Duty], object] = _ignore
        self.coverage = Coverage()
        self.response_times = ResponseTimes()
        self.vocabulary = Vocabulary(ruleset, chains)
        self.duties = OpenDuties(seconds)
        self.constraints = ConstraintMonitor(seconds, self._rules_of)
        self.history = HistoryMonitor(self._rules_of)
        self.permissions = Permissions(seconds, untimed)
        self.moment = Moment(0, domain, {})
        self.simultaneous: set[str] = set()
        self.unobserved: set[str] = set()
        """The obligations whose executions are not always recorded. That one was not executed is then unknown."""
        self.untimed = untimed
        self._maker = DutyMaker(ruleset.reading, untimed)
        self._domains: dict[str | None, DomainRules] = {}

    def begin_late(self, time: Rational, is_domain_known: bool = True) -> None:
        """The mission began before `time`, unobserved. What rules required then is unknown, and so is what occurred.
        The domain is that of the constructor, or unknown."""
        if not is_domain_known:
            self.moment.domain = UNKNOWN_DOMAIN
        self.history.is_late = True
        for rule in self.ruleset.rules:
            self.permissions.permit_all(rule, time)

    @property
    def time(self) -> Rational:
        """The time of the last observation."""
        return self.moment.time

    def observe(self, observation: Observation) -> list[Deviation]:
        """The deviations that an observation shows: of itself, or of what has ended before it."""
        found = []
        now = self.moment.time
        if observation.time > now:
            found = self._advance(observation.time)
        elif observation.time < now:
            detail = f"an observation is {float(now - observation.time):g} s earlier than the one before it"
            found = [Deviation("out-of-order", observation.time, detail=detail)]
        if isinstance(observation, Reported):
            found += self._report(observation)
        elif isinstance(observation, Occurred):
            found += self._occur(observation.event)
        elif isinstance(observation, Executed):
            found += self._execute(observation.obligation)
        else:
            found += self._enter(observation)
        return found

    def advance(self, time: Rational) -> list[Deviation]:
        """The deviations that are certain at `time`, before anything is observed at that time."""
        return self._advance(time) if time > self.moment.time else []

    def _advance(self, time: Rational) -> list[Deviation]:
        found = self._close()
        self.simultaneous = set()
        self.moment = Moment(time, self.moment.domain, self.moment.conditions)
        for duty in self.duties.advance(time):
            found += self._settled(duty)
        found += self.constraints.advance(time)
        return found

    def finish(self, time: Rational | None = None) -> list[Deviation]:
        """The end of the mission, at `time` or with the last observation. Nothing can be observed after it.

        A prohibition that is in force at the end was kept. What is ``open``: an obligation whose window has not closed,
        and a constraint that an event within the tolerance could still fulfil.
        """
        found = self.advance(self.moment.time if time is None else time)
        found += self._close()
        found += self.constraints.flush(self.moment.time)
        for duty in self.duties:
            dues = tuple(duty.task.dues())
            is_open = any(due.met is None and not due.obligation.negated for due in dues)
            for due in dues:
                if due.met is None and due.obligation.negated:
                    due.met = True
            if duty.task.met() is None and is_open:
                found.append(self._deviation(duty, "open"))
            else:
                found += self._settled(duty)
        return found

    # Observations -----------------------------------------------------------------------------------------------------

    def _enter(self, observation: Entered) -> list[Deviation]:
        domain = observation.domain
        found: list[Deviation] = []
        if domain is not None and domain not in (UNKNOWN_DOMAIN, *self.ruleset.domains):
            found = self._unknown("domain", domain)
            domain = self.moment.domain if observation.request else UNKNOWN_DOMAIN
        if domain != self.moment.domain:
            found += self._close()
            self.moment = Moment(self.moment.time, domain, self.moment.conditions, has_entered=True)
        return found

    def _report(self, observation: Reported) -> list[Deviation]:
        found: list[Deviation] = []
        new: dict[str, Value | None] = {}
        for name, value in observation.conditions.items():
            if name not in self.vocabulary.conditions:
                found += self._unknown("condition", name)
                continue
            try:
                new[name] = None if value is None else fit(name, value, self.ruleset.measures.get(name))
            except WrongType as error:
                new[name] = None
                found.append(Deviation("wrong-value", self.moment.time, name=name, detail=error.message))
        changed = {name for name, value in new.items() if self.moment.conditions.get(name) != value}
        if not changed:
            return found
        if self.moment.occurred or self.moment.executed:
            found += self._close()
            self.moment = Moment(self.moment.time, self.moment.domain, self.moment.conditions)
        values = {**self.moment.conditions, **new}
        self.moment.conditions = {name: value for name, value in values.items() if value is not None}
        self.moment.changed |= changed
        return found

    def _occur(self, event: str) -> list[Deviation]:
        if event not in self.vocabulary.events:
            return self._unknown("event", event)
        self.moment.is_triggered = True
        self.moment.occurred.add(event)
        if self.chains:
            self.moment.executed.add(event)
        return []

    def _execute(self, obligation: str) -> list[Deviation]:
        if obligation not in self.vocabulary.obligations:
            return self._unknown("obligation", obligation)
        self.moment.executions.append(obligation)
        self.moment.executed.add(obligation)
        if self.chains:
            self.moment.occurred.add(obligation)
        return []

    def _unknown(self, kind: str, name: str) -> list[Deviation]:
        detail = self.vocabulary.unknown(kind, name)
        return [] if detail is None else [Deviation("unknown-name", self.moment.time, name=name, detail=detail)]

    # Moments ----------------------------------------------------------------------------------------------------------

    def _close(self) -> list[Deviation]:
        """The deviations of the present moment, which ends."""
        moment = self.moment
        if not (moment.occurred or moment.executed or moment.changed or moment.has_entered):
            return []
        found = list(self._trigger(moment))
        unrequired = [name for name in moment.executions if not self._is_required(name, moment.time)]
        for event in sorted(moment.executed):
            for duty in self.duties.occur(event, moment.time, max(1, moment.executions.count(event))):
                found += self._settled(duty)
        prohibited = {one.obligation.name for one in found if one.kind == "prohibited" and one.obligation is not None}
        found += [
            Deviation("unrequired", moment.time, name=name, last=self.permissions.until.get(name))
            for name in unrequired
            if name not in prohibited
        ]
        self.simultaneous |= moment.executed
        found += self.constraints.observe(moment)
        found += self.history.observe(moment)
        return found

    def _is_required(self, event: str, now: Rational) -> bool:
        return self.permissions.permits(event, now, self.duties.requires(event, now))

    def _trigger(self, moment: Moment) -> Iterator[Deviation]:
        if not moment.occurred:
            return
        rules = self._rules_of(moment.domain)
        situation = rules.context(moment)
        for event in sorted(moment.occurred & rules.by_trigger.keys()):
            for rule in rules.by_trigger[event]:
                yield from self._decide(rule, moment, situation)
        if moment.domain == UNKNOWN_DOMAIN:
            for event in sorted(moment.occurred & self._rules_of(None).by_trigger.keys()):
                for rule in self._rules_of(None).by_trigger[event]:
                    if rule.domains is not None:
                        self.permissions.permit_all(rule, moment.time)
                        triggered = Triggered(moment.time, rule.label, situation.context, None)
                        yield Deviation("undetermined", moment.time, triggered, missing=("domain",))

    def _decide(self, rule: Rule, moment: Moment, situation: Situation) -> Iterator[Deviation]:
        outcome = walk(rule, situation, self.ruleset.reading)
        decision = outcome if isinstance(outcome, Decision) else None
        self.coverage.count(rule, outcome)
        if outcome is None:
            return
        triggered = Triggered(moment.time, rule.label, situation.context, decision)
        if not isinstance(outcome, Decision):
            self.permissions.permit_all(rule, moment.time)
            yield Deviation("undetermined", moment.time, triggered, missing=outcome.missing)
            return
        for duty in self._maker.duties(triggered, situation):
            self.on_duty(duty)
            self.duties.add(duty, self.simultaneous, moment.time)
            if duty.settled:
                yield from self._settled(duty)

    def _settled(self, duty: Duty) -> list[Deviation]:
        met = duty.task.met()
        self.response_times.record(duty)
        self.permissions.end(duty)
        if met:
            return []
        if met is None or any(self._is_unobserved(due) for due in duty.task.dues()):
            return [self._deviation(duty, "undetermined")]
        return [self._deviation(duty, "missed")]

    def _is_unobserved(self, due: Due) -> bool:
        """Whether an obligation may have been executed although nothing was recorded."""
        return due.met is False and not due.obligation.negated and due.obligation.name in self.unobserved

    def _deviation(self, duty: Duty, kind: DeviationKind) -> Deviation:
        failed = [due for due in duty.task.dues() if due.met is False]
        due = max(failed, key=lambda due: due.since if due.at is None else due.at, default=None)
        due = due or next(iter(duty.task.dues()), None)
        if kind == "missed" and due is not None and due.obligation.negated:
            kind = "prohibited"
        triggered = duty.triggered
        if due is None or kind in ("open", "undetermined"):
            assert triggered.decision is not None
            obligation = triggered.decision.obligations[duty.number]
        else:
            obligation = due.obligation
        times = [one.at for one in (duty.task.dues() if kind == "undetermined" else failed) if one.at is not None]
        at = self.moment.time if kind == "open" else max(times, default=triggered.time)
        return Deviation(
            kind,
            max(at, triggered.time),
            triggered,
            obligation,
            None if due is None else due.first,
            None if due is None else due.last,
            missing=tuple(
                dict.fromkeys(
                    [
                        *duty.task.unreported(),
                        *(one.obligation.name for one in duty.task.dues() if self._is_unobserved(one)),
                    ]
                )
            ),
        )

    def _rules_of(self, domain: str | None) -> DomainRules:
        if domain not in self._domains:
            ruleset = self.ruleset if domain is None else self.ruleset.in_domain(domain)
            self._domains[domain] = DomainRules(ruleset)
        return self._domains[domain]


def _ignore(duty: Duty) -> None:
    """Nobody asks for duties."""
