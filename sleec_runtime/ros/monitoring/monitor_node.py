"""The monitor node: it watches a robot, and publishes each deviation from the rules while it happens."""

from __future__ import annotations

import logging
import threading
import uuid
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import BREACHES, Deviation
from sleec_runtime.audit.mapping import Misfit
from sleec_runtime.audit.mapping_file import NO_MAPPING, MappingFile
from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.errors import SleecError
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport, report_of
from sleec_runtime.ros.monitoring.live_topics import WATCHED, live_topics
from sleec_runtime.ros.monitoring.robot_mapping import RobotMapping
from sleec_runtime.ros.monitoring.wall_clock import WallClock
from sleec_runtime.ros.node import Node, OnProblem, seconds_of
from sleec_runtime.ros.problems import Unfit
from sleec_runtime.ros.transport import Fields, Topic, Transport
from sleec_runtime.support.messages import listed
from sleec_runtime.timed.clock import Clock
from sleec_runtime.timed.failures import raise_interrupt

_LOG = logging.getLogger("sleec_runtime.ros")

PERIOD = 0.1
"""Seconds between two checks of the clock. A missed deadline is reported at most this much later."""
PATIENCE = 10.0
"""Seconds after which topics without a message are logged."""


class MonitorNode(Node):
    """Compares what a robot does with what the rules require, as `sleec-verify audit` does with a recording.

    The monitor publishes each deviation on /deviations, logs it, and gives it to `on_deviation`. `auditor` has the
    rules and the options of the audit, and belongs to this node. `mapping` maps the messages of the robot that
    are not those of our nodes. `clock` gives the times, in seconds since 1970.

    The robot may run before the monitor, which is then `late`: what happened before is unknown. A message that the
    mapping does not fit is reported once for each entry of the mapping, and a value that does not fit once for each
    name. `problems` counts both. The values that they should contain are unknown.

    Raises MappingError for a topic without a type, WrongType for a wrong `period` or `patience`, and as
    `transport.subscribe`.
    """

    def __init__(
        self,
        auditor: Auditor,
        transport: Transport,
        mapping: MappingFile = NO_MAPPING,
        *,
        late: bool = True,
        name: str = "monitor",
        clock: Clock | None = None,
        period: float = PERIOD,
        patience: float = PATIENCE,
        on_deviation: Callable[[Deviation], object] | None = None,
        on_problem: OnProblem | None = None,
    ) -> None:
        super().__init__(name, transport, clock or WallClock(), on_problem)
        self.auditor = auditor
        self.monitor = uuid.uuid4().hex
        self.published = 0
        """The number of deviations."""
        self.has_found_breach = False
        """Whether a deviation shows that the rules, or their assumptions, do not hold."""
        self.problems: Counter[str] = Counter()
        """The number of messages that do not fit, by the entry of the mapping, or by the name of the value."""
        self._mapping = RobotMapping(mapping.sources, late)
        self._on_deviation = on_deviation
        self._lock = threading.RLock()
        self._send = self.sender(DeviationReport)
        if late:
            is_domain_known = auditor.moment.domain is not None or not self._mapping.has_domain
            auditor.begin_late(self.exact_time(), is_domain_known)
        topics = live_topics(WATCHED, mapping)
        self._silent = set(self._mapping.topics or self._mapping.node_topics)
        patience = seconds_of(patience, "patience")
        self._cancel_patience = self.clock.wake(self.clock.now() + patience, self._report_silence)
        with self.starting():
            for topic in topics:
                transport.subscribe(topic, partial(self._watch, topic))
            self.every(period, self._advance)

    def close(self) -> None:
        """Ends the monitor, and publishes the open obligations. The transport stays open."""
        with self._lock:
            if self.closed:
                return
            self._publish(self.auditor.finish(self.exact_time()))
            super().close()
            self._cancel_patience()

    def _watch(self, topic: Topic, fields: Fields) -> None:
        with self._lock:
            if self.closed:
                return
            self._silent.discard(topic.name)
            message = RawMessage(self.exact_time(), topic.name, topic.type, fields)
            for observation in self._mapping.observations(message):
                if isinstance(observation, Misfit):
                    if observation.source.kind == "obligation":
                        self.auditor.unobserved.add(observation.source.name)
                    self._count(observation)
                else:
                    self._publish(self.auditor.observe(observation))
            self._advance()

    def _advance(self) -> None:
        """Publishes the deviations that are certain now. Events are decided once their time has passed."""
        with self._lock:
            if not self.closed:
                self._publish(self.auditor.advance(self.exact_time()))

    def _publish(self, deviations: Iterable[Deviation]) -> None:
        for deviation in deviations:
            if deviation.kind == "wrong-value" and not self._is_first(deviation.name):
                continue
            report = report_of(deviation, self.monitor, self.published, self.exact_time())
            self.published += 1
            self.has_found_breach |= deviation.kind in BREACHES
            _LOG.warning("%s: %s", self.name, report.text)
            try:
                self._send(report)
            except SleecError as error:
                self.report(error, report.topic.name)
            if self._on_deviation is not None:
                try:
                    self._on_deviation(deviation)
                except BaseException as error:  # noqa: BLE001 - the monitor continues
                    _LOG.exception("on_deviation failed")
                    raise_interrupt(error)

    def _count(self, misfit: Misfit) -> None:
        if self._is_first(misfit.source.where):
            self.report(Unfit(f"{misfit.source.where}: {misfit.message}"), misfit.source.topic)

    def _is_first(self, problem: str) -> bool:
        """Counts a problem. Whether it is the first of its kind."""
        self.problems[problem] += 1
        return self.problems[problem] == 1

    def _report_silence(self) -> None:
        with self._lock:
            if self._silent:
                _LOG.warning(
                    "%s: no message has arrived yet on %s; if one should have, check its name and type",
                    self.name,
                    listed(sorted(self._silent)),
                )
