"""The audit of one log."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.mapping import Misfit
from sleec_runtime.audit.observation import (
    Entered,
    Executed,
    Observation,
    Occurred,
    RawMessage,
    read_line,
    write_line,
)
from sleec_runtime.audit.ordering import Ordering
from sleec_runtime.audit.state import restore, save
from sleec_runtime.errors import SleecError, SnapshotRefused
from sleec_runtime.model import Rational, Ruleset, literals
from sleec_runtime.ros.monitoring.robot_mapping import RobotMapping
from sleec_runtime.support.messages import listed
from sleec_runtime.support.suggestions import nearest
from sleec_runtime.timed.plain_data import number_from_plain, number_to_plain
from sleec_verify.audit.mission_result import MissionResult
from sleec_verify.audit.readers.forms import open_log
from sleec_verify.audit.readers.reader import IndexedReader, Item, Position, Unreadable
from sleec_verify.audit.record import Record, record_from, record_of
from sleec_verify.audit.settings import Settings
from sleec_verify.audit.timeline_recorder import TimelineRecorder

LISTED = 20
"""How many deviations of one obligation, constraint or name are listed. The others are counted."""

_PACE = 1_000
"""Items between two reports of the progress."""

_MOST_TOPICS = 10_000
_MOST_GROUPS = 10_000
"""Different deviations that are listed, such as unknown names."""


class Mission:
    """The audit of the log at `path`: the listed deviations, the number of each group, and the position in the log."""

    def __init__(self, path: str, ruleset: Ruleset, settings: Settings) -> None:
        self.path = path
        self.ruleset = ruleset
        self.settings = settings
        self.records: list[Record] = []
        self.counts: Counter[tuple[object, ...]] = Counter()
        self.observations = 0
        self.first: Rational | None = None
        self.position: Position = None
        self.topics: set[str] = set()
        self._entered = False
        self._names_events = False
        self._ungrouped = 0
        self._provisional: list[Unreadable] = []
        self.auditor = Auditor(
            ruleset,
            domain=settings.domain,
            tolerance=settings.tolerance,
            untimed=settings.untimed,
            chains=settings.chains,
        )
        self._mapping = RobotMapping(settings.sources, settings.late)
        self._timeline: TimelineRecorder | None = None
        self._index: frozenset[str] = frozenset()
        self._ordering: Ordering[Observation | RawMessage] = Ordering(settings.max_lag)

    def record_timeline(self) -> TimelineRecorder:
        """The recorder of the timeline from now on. Call it before anything is read."""
        self._timeline = TimelineRecorder(self.path, self.auditor)
        return self._timeline

    def read(self, progress: Callable[[float], None] | None = None, pause: Callable[[], object] | None = None) -> None:
        """Audits the rest of the log. `progress` receives the fraction read. `pause` is called periodically,
        when the state can be saved. An unreadable last line is not part of the state: a later run reads it again.

        Raises UnreadableLog.
        """
        reader = open_log(Path(self.path), self._mapping.topics | self._mapping.node_topics)
        for number, (position, item) in enumerate(reader.read(self.position), 1):
            if isinstance(item, Unreadable) and position == self.position:
                self._provisional.append(item)
                continue
            self._observe(item)
            self.position = position
            if number % _PACE == 0:
                if progress is not None:
                    progress(reader.fraction(position))
                if pause is not None:
                    pause()
        if isinstance(reader, IndexedReader):
            self._index = reader.topics

    def finish(self) -> MissionResult:
        """The end of the mission. Nothing can be read after it."""
        for item in self._provisional:
            self._take(item)
        for held in self._ordering.held():
            self._take(held)
        self._add(self.auditor.finish())
        if not self.auditor.coverage.triggered:
            unused = sorted((self.topics | self._index) - self._mapping.topics - self._mapping.node_topics)
            hint = f"; map its topics to the names of the rules: {listed(unused)}" if unused else ""
            self._record(Record("nothing-audited", f"no rule is triggered in this log, so nothing was audited{hint}"))
        known = sorted(self.topics | self._index)
        for topic in sorted(self._mapping.topics - self.topics):
            near = nearest(topic, known)
            has = f"; it has {listed(known)}" if known else ""
            hint = f"; did you mean `{near}`?" if near else has
            if self._index and topic not in self._index:
                kind, message = "unrecorded-topic", f"the recording does not have the topic `{topic}`{hint}"
            else:
                kind, message = "missing-topic", f"the log has no message on the topic `{topic}`{hint}"
            self._record(Record(kind, message, name=topic))
        unmapped = self._unmapped()
        if unmapped:
            names = listed([f"`{name}`" for name in unmapped])
            verb = "it occurs" if len(unmapped) == 1 else "they occur"
            problem = f"the mapping has no entry for {names}, so the audit cannot see when {verb}"
            self._record(Record("missing-topic", problem))
        auditor = self.auditor
        return MissionResult(
            self.path,
            self.observations,
            self.first,
            None if self.first is None else auditor.time,
            tuple(self.records),
            sum(self.counts.values()) - len(self.records) + self._ungrouped,
            auditor.coverage,
            auditor.response_times,
            self._entered,
        )

    def state(self) -> dict[str, Any]:
        """The state of an audit that is not finished, as plain data."""
        return {
            "position": self.position,
            "auditor": save(self.auditor),
            "mapping": self._mapping.state(),
            "held": [write_line(one) for one in self._ordering.held()],
            "records": [record.plain() for record in self.records],
            "more": [[record.plain(), self.counts[record.group]] for record in self._firsts()],
            "entered": self._entered,
            "names_events": self._names_events,
            "ungrouped": self._ungrouped,
            "observations": self.observations,
            "first": None if self.first is None else number_to_plain(self.first),
            "topics": sorted(self.topics),
        }

    def resume(self, state: Any) -> None:
        """Continues an audit of the same rules. Raises SnapshotRefused for a state that is not that of one."""
        try:
            self.auditor = restore(self.ruleset, state["auditor"])
            self.position = state["position"]
            self._mapping.restore(state["mapping"])
            self._ordering.hold(read_line(line) for line in state["held"])
            self.records = [record_from(plain) for plain in state["records"]]
            self.counts = Counter({record_from(plain).group: number for plain, number in state["more"]})
            self._entered = bool(state["entered"])
            self._names_events = bool(state["names_events"])
            self._ungrouped = state["ungrouped"]
            self.observations = state["observations"]
            self.first = None if state["first"] is None else number_from_plain(state["first"])  # type: ignore[assignment]
            self.topics = set(state["topics"])
        except (KeyError, TypeError, ValueError):
            raise SnapshotRefused("the state of the audit is malformed", "audit the log from its start") from None
        except SleecError as error:
            raise SnapshotRefused(error.message, error.hint) from None

    def _unmapped(self) -> list[str]:
        """The events and obligations that no message can mean, if a mapping alone gives the log its meaning."""
        if not self._mapping.sources or self._names_events:
            return []
        events, obligations = self._mapping.named("event"), self._mapping.named("obligation")
        if self.settings.chains:
            events = obligations = events | obligations
        rules = self.ruleset.rules
        triggers = {rule.trigger for rule in rules}
        required = {one.name for rule in rules for clause in rule.clauses() for one in literals(clause)}
        return sorted((triggers - events) | (required - obligations))

    def _firsts(self) -> Sequence[Record]:
        return tuple({record.group: record for record in reversed(self.records)}.values())

    def _observe(self, item: Item) -> None:
        if self.settings.max_lag and not isinstance(item, Unreadable):
            for due in self._ordering.insert(item):
                self._take(due)
        else:
            self._take(item)

    def _take(self, item: Item) -> None:
        if isinstance(item, Unreadable):
            hint = "" if item.hint is None else f" ({item.hint})"
            self._record(Record("unreadable", f"{item.place}: {item.message}{hint}", line=item.line))
            if item.rest is not None:
                self._observe(item.rest)
        elif isinstance(item, RawMessage):
            if len(self.topics) < _MOST_TOPICS:
                self.topics.add(item.topic)
            for meaning in self._mapping.observations(item):
                if isinstance(meaning, Misfit):
                    if meaning.source.kind == "obligation":
                        self.auditor.unobserved.add(meaning.source.name)
                    where = meaning.source.where
                    problem = f"the mapping of {where} does not fit `{item.topic}`: {meaning.message}"
                    self._record(Record("unreadable", problem, item.time, name=where))
                else:
                    self._audit(meaning, item.topic in self._mapping.topics)
        else:
            self._audit(item)

    def _audit(self, observation: Observation, is_mapped: bool = False) -> None:
        self.observations += 1
        self._names_events |= not is_mapped and isinstance(observation, (Occurred, Executed))
        self._entered = self._entered or isinstance(observation, Entered)
        if self.first is None:
            self.first = observation.time
            if self.settings.late:
                is_domain_known = self.settings.domain is not None or not self._mapping.has_domain
                self.auditor.begin_late(observation.time, is_domain_known)
        if self._timeline is not None:
            self._timeline.observe(observation)
        self._add(self.auditor.observe(observation))

    def _add(self, deviations: Sequence[Deviation]) -> None:
        for deviation in deviations:
            self._record(record_of(deviation, self.ruleset))
            if self._timeline is not None:
                self._timeline.deviate(deviation)

    def _record(self, record: Record) -> None:
        if len(self.counts) >= _MOST_GROUPS and record.group not in self.counts:
            self._ungrouped += 1
            return
        self.counts[record.group] += 1
        if self.counts[record.group] <= LISTED:
            self.records.append(record)
