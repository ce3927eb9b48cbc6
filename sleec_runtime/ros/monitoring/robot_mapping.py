"""The observations in the messages of a robot: by a mapping for its own topics, and directly for those of our nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice
from typing import Any

from sleec_runtime.audit.mapping import Misfit, TopicMapping
from sleec_runtime.audit.observation import Entered, Observation, Occurred, RawMessage, Reported
from sleec_runtime.audit.observation import Executed as Execution
from sleec_runtime.audit.source import Source
from sleec_runtime.errors import MappingError
from sleec_runtime.ros.messages import ConditionsUpdate, DomainChange, Executed, LayersUpdate, MissionEvent
from sleec_runtime.ros.recent_ids import RecentIds
from sleec_runtime.ros.transport import STRING
from sleec_runtime.ros.transport_errors import MalformedMessage
from sleec_runtime.support.messages import represent

SOON = 0.1
"""Seconds after a trigger within which a report of a task counts as the trigger."""
SAME = 1.0
"""Seconds within which reports of several tasks are about one occurrence of a trigger."""

MOST_NAMES = 100_000
"""Names of messages that are remembered, so that no robot with ever new names exhausts the memory."""


class RobotMapping(TopicMapping):
    """The sources of a mapping, and the meaning of the messages of our nodes, on topics and about names that have no
    source:

    - /domain has the domain, /conditions the reported values, /mission the triggers, and /executed the executed
      obligations;
    - /layers_update is the context that the Context Manager has. It counts for the domain and the conditions that were
      not on /domain and /conditions, such as those that were reported before the recording began;
    - a task may follow a topic of its own, which the mapping should have. Without it, the trigger occurs when the task
      reports it, if this is soon enough that the context is still the same.

    On these topics, a message that is not a JSON object in a String is not from our nodes, and is ignored.
    """

    def __init__(self, sources: Iterable[Source] = (), late: bool = False) -> None:
        super().__init__(sources, late)
        self.node_topics = frozenset(_MEANINGS) - self.topics
        """The topics of our nodes that are interpreted."""
        self._reported: set[str] = set()
        self._followed: set[str] = set()
        self._is_domain_known = False
        self._missions = RecentIds()
        self._own_conditions = self.named("condition", "measure")
        self._own_events = self.named("event")
        self._own_obligations = self.named("obligation")
        self._known = set(self._own_events)
        self._triggered: dict[str, tuple[float, list[str]]] = {}

    def observations(self, message: RawMessage) -> Iterator[Observation | Misfit]:
        """What a message means. See `TopicMapping.observations`."""
        if message.topic not in self.node_topics:
            yield from super().observations(message)
            return
        fields: object = message.fields
        data = fields.get("data") if isinstance(fields, Mapping) else None
        if message.type not in (None, STRING) or not isinstance(data, str) or not data.lstrip().startswith("{"):
            return
        try:
            for observation in _MEANINGS[message.topic](self, message):
                yield from self._about_others(observation)
        except MalformedMessage as error:
            yield _misfit(message, error.message)

    def _about_others(self, observation: Observation | Misfit) -> Iterator[Observation | Misfit]:
        """What an observation says about names that have no source."""
        if isinstance(observation, Reported):
            values = {n: v for n, v in observation.conditions.items() if n not in self._own_conditions}
            if values:
                yield Reported(observation.time, values)
        elif not (
            (isinstance(observation, Occurred) and observation.event in self._own_events)
            or (isinstance(observation, Execution) and observation.obligation in self._own_obligations)
            or (isinstance(observation, Entered) and self.has_domain)
        ):
            yield observation

    def state(self) -> Any:
        """See `TopicMapping.state`."""
        own = {
            "reported": sorted(self._reported),
            "followed": sorted(self._followed),
            "is_domain_known": self._is_domain_known,
            "missions": self._missions.ids(),
            "known": sorted(self._known),
            "triggered": [[name, time, nodes] for name, (time, nodes) in self._triggered.items()],
        }
        return {**super().state(), "nodes": own}

    def restore(self, state: Any) -> None:
        """See `TopicMapping.restore`."""
        super().restore(state)
        try:
            own = state["nodes"]
            self._reported, self._followed = set(own["reported"]), set(own["followed"])
            self._is_domain_known = own["is_domain_known"]
            for one in own["missions"]:
                self._missions.add(one)
            self._known = set(own["known"])
            self._triggered = {name: (time, nodes) for name, time, nodes in own["triggered"]}
        except (KeyError, TypeError, ValueError):
            raise MappingError(f"{represent(state)} is not the state of a mapping") from None

    def _domain(self, message: RawMessage) -> Iterator[Observation]:
        domain = DomainChange.from_fields(message.fields).domain
        self._is_domain_known = True
        yield Entered(message.time, domain, request=True)

    def _conditions(self, message: RawMessage) -> Iterator[Observation]:
        conditions = ConditionsUpdate.from_fields(message.fields).conditions
        _remember(self._reported, conditions)
        yield Reported(message.time, conditions)

    def _layers(self, message: RawMessage) -> Iterator[Observation]:
        update = LayersUpdate.from_fields(message.fields)
        if not self._is_domain_known:
            yield Entered(message.time, update.domain)
        forgotten = dict.fromkeys(self._followed) if update.full else {}
        if update.full:
            self._followed.clear()
        _remember(self._followed, update.conditions)
        values = {**forgotten, **update.conditions}
        conditions = {name: value for name, value in values.items() if name not in self._reported}
        if conditions:
            yield Reported(message.time, conditions)

    def _mission(self, message: RawMessage) -> Iterator[Observation]:
        event = MissionEvent.from_fields(message.fields)
        _remember(self._known, [event.trigger])
        if self._missions.add(event.id):
            yield Occurred(message.time, event.trigger)

    def _executed(self, message: RawMessage) -> Iterator[Observation | Misfit]:
        report = Executed.from_fields(message.fields)
        if report.trigger is not None and report.trigger not in self._known and self._is_new(report):
            if report.time - report.triggered <= SOON:
                yield Occurred(message.time, report.trigger)
            else:
                problem = f"the time of `{report.trigger}` is not known; add the topic that triggers it to the mapping"
                yield _misfit(message, problem)
        problem = "the report says what the rules require, and not what the robot executed"
        for obligation in report.due if report.executed is None else report.unrecorded:
            yield Misfit(message.time, Source(message.topic, "obligation", obligation, message.topic), problem)
        for obligation in report.executed or ():
            yield Execution(message.time, obligation)

    def _is_new(self, report: Executed) -> bool:
        """Whether a report is the first one about its trigger. Other nodes may report the same occurrence."""
        assert report.trigger is not None
        since, nodes = self._triggered.get(report.trigger, (0.0, []))
        if report.node not in nodes and abs(report.triggered - since) <= SAME:
            if len(nodes) < MOST_NAMES:
                nodes.append(report.node)
            return False
        if report.trigger in self._triggered or len(self._triggered) < MOST_NAMES:
            self._triggered[report.trigger] = report.triggered, [report.node]
        return True


def _remember(names: set[str], more: Iterable[str]) -> None:
    names.update(islice(more, max(0, MOST_NAMES - len(names))))


def _misfit(message: RawMessage, problem: str) -> Misfit:
    return Misfit(message.time, Source(message.topic, "event", "", message.topic), problem)


_MEANINGS: Mapping[str, Callable[[RobotMapping, RawMessage], Iterator[Observation | Misfit]]] = {
    DomainChange.topic.name: RobotMapping._domain,
    ConditionsUpdate.topic.name: RobotMapping._conditions,
    LayersUpdate.topic.name: RobotMapping._layers,
    MissionEvent.topic.name: RobotMapping._mission,
    Executed.topic.name: RobotMapping._executed,
}
