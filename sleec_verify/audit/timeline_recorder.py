"""The timeline of a mission, recorded while it is audited."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import BREACHES, Deviation
from sleec_runtime.audit.duty import Due, Duty
from sleec_runtime.audit.moment import UNKNOWN_DOMAIN
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, Reported
from sleec_runtime.audit.wording import message, time_text
from sleec_runtime.model import Rational, obligation_text
from sleec_verify.results.mission_timeline import (
    Change,
    DeviationMark,
    DueWindow,
    MissionTimeline,
    Occurrence,
    WindowState,
)

MOST = 20_000
"""The most marks that are kept. More cannot be distinguished in a picture."""

_Mark = TypeVar("_Mark")


class TimelineRecorder:
    """Records the mission that `auditor` audits. It keeps the first `MOST` marks."""

    def __init__(self, title: str, auditor: Auditor) -> None:
        self._timeline = MissionTimeline(title)
        self._duties: list[Duty] = []
        self._size = 0
        self._values: dict[str, object] = {}
        self._is_begun = False
        auditor.on_duty = self._begin

    def observe(self, observation: Observation) -> None:
        """Records what was observed. Call it before the auditor observes it."""
        timeline = self._timeline
        if not self._is_begun:
            self._is_begun = True
            timeline.start = observation.time
        # An observation that is out of order counts at the time of the one before it.
        time = timeline.end = max(timeline.end, observation.time)
        if isinstance(observation, Entered):
            name = "not known" if observation.domain == UNKNOWN_DOMAIN else observation.domain or ""
            if not timeline.domains or timeline.domains[-1].name != name:
                self._keep(timeline.domains, Change(time, name, None))
        elif isinstance(observation, Occurred):
            self._keep(timeline.triggers, Occurrence(time, observation.event))
        elif isinstance(observation, Executed):
            self._keep(timeline.executions, Occurrence(time, observation.obligation))
        elif isinstance(observation, Reported):
            for name, value in observation.conditions.items():
                if self._values.get(name) != value or name not in self._values:
                    self._values[name] = value
                    self._keep(timeline.changes, Change(time, name, value))

    def deviate(self, deviation: Deviation) -> None:
        """Records a deviation."""
        words = message(deviation).removeprefix(f"at {time_text(deviation.time)}, ")
        time = self._timeline.end if deviation.kind == "out-of-order" else deviation.time
        mark = DeviationMark(time, words, deviation.kind in BREACHES)
        self._keep(self._timeline.deviations, mark)

    def finish(self) -> MissionTimeline:
        """The timeline. Call it after the auditor has finished."""
        timeline = self._timeline
        timeline.windows = [window for duty in self._duties for window in _windows(duty)]
        timeline.windows.sort(key=lambda window: window.first)
        timeline.deviations.sort(key=lambda mark: mark.time)
        if timeline.cut is not None:
            timeline.end = timeline.cut
        return timeline

    def _begin(self, duty: Duty) -> None:
        # The picture shows the state of a duty at the end of the mission.
        self._keep(self._duties, duty)

    def _keep(self, marks: list[_Mark], mark: _Mark) -> None:
        self._size += 1
        if self._size <= MOST:
            marks.append(mark)
        elif self._timeline.cut is None:
            self._timeline.cut = self._timeline.end


def _windows(duty: Duty) -> Iterator[DueWindow]:
    """The windows of a duty. Those of an alternative that was not necessary are left out, and so are prohibitions
    whose window has a negative length."""
    for due in duty.task.dues():
        has_effect = not due.obligation.negated or due.last is None or due.first <= due.last
        if has_effect and not (due.met is None and duty.settled and duty.task.met()):
            last: Rational | None = due.last
            if last is not None and due.met and due.at is not None:
                last = max(last, due.at)  # executed within the tolerance
            yield DueWindow(due.obligation.name, _words(duty, due), _state(due), due.first, last)


def _words(duty: Duty, due: Due) -> str:
    verb = "prohibits" if due.obligation.negated else "requires"
    text = obligation_text(due.obligation).removeprefix("NOT ")
    return f"rule {duty.triggered.rule} {verb} {text}"


def _state(due: Due) -> WindowState:
    if due.obligation.negated:
        return "prohibited"
    return "open" if due.met is None else "met" if due.met else "missed"
