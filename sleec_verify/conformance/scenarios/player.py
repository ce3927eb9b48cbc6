"""Plays a scenario on a robot, on a virtual clock, and records what happens when."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from functools import partial

from sleec_runtime.dispatch.recording import recording
from sleec_runtime.errors import ConflictInContext, NeedsAwait, SleecError, UndeterminedDecision, VariantsFailed
from sleec_runtime.model import Value
from sleec_runtime.timed.clock import Time
from sleec_verify.conformance.other_threads import Provoked, awaited
from sleec_verify.conformance.scenarios.clock import ScenarioClock, second
from sleec_verify.conformance.scenarios.course import Course, Happening, Kind
from sleec_verify.conformance.scenarios.event_loop import ScenarioLoop
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from sleec_verify.conformance.subject import Arguments, Bench, Subject, needs_running_loop

_FOR_EVER = float("inf")
_MOST_ACTS = 10_000


class WithheldCompletion(Provoked):
    """The exception that a scenario raises in a callable that would complete what the scenario does not complete."""


def play(bench: Bench, scenario: Scenario, obligations: Collection[str] | None = None) -> Course:
    """The course of a scenario on a new subject of `bench`, whose `obligations` are observed: by default those of its
    rules.

    At one time, the acts of the scenario come first, then what the clock starts. If code of the subject is
    asynchronous, the scenario runs in an event loop, in which time is that of the clock. Raises `NotASubject`, and the
    exceptions of the factory.
    """
    if not bench.asynchronous:
        try:
            return _played(bench, scenario, obligations, ScenarioClock(), None)
        except (NeedsAwait, RuntimeError) as error:
            if isinstance(error, RuntimeError) and not needs_running_loop(error):
                raise
            bench.needs_loop()
    clock = ScenarioClock()
    loop = ScenarioLoop(clock)
    try:
        return _played(bench, scenario, obligations, clock, loop)
    finally:
        loop.stop_tasks()


def _played(
    bench: Bench,
    scenario: Scenario,
    obligations: Collection[str] | None,
    clock: ScenarioClock,
    loop: ScenarioLoop | None,
) -> Course:
    make = partial(bench.subject, clock)
    subject = make() if loop is None else loop.result_of(make)
    names = subject.ruleset.obligations if obligations is None else obligations
    with bench.observed(subject, names):
        player = Player(subject, clock, scenario.completions, loop, bench.arguments)
        for step in scenario.steps:
            player.go_to(step.at)
            player.step(step)
        return player.course(scenario.end)


class Player:
    """Moves a subject through time, completes what takes time, and records what happens.

    `completions` says when an obligation is completed; without one, at once. In an event `loop`, coroutines run.
    """

    def __init__(
        self,
        subject: Subject,
        clock: ScenarioClock,
        completions: Sequence[Completion] = (),
        loop: ScenarioLoop | None = None,
        arguments: Arguments = (),
    ) -> None:
        self.subject = subject
        self.happenings: list[Happening] = []
        self.values: dict[int, Mapping[str, Value]] = {}
        self._clock = clock
        self._loop = loop
        self._arguments = arguments
        self._completions = list(completions)
        self._used: dict[str, tuple[int, Completion | None]] = {}
        """The last completion of each name, with the time at which the name was started."""
        self._due: list[tuple[int, str]] = []
        """What was started and takes time: when the scenario completes it."""
        self._completed: dict[str, int] = {}
        """The time of the last completion of each obligation."""
        self._withheld: dict[str, int] = {}
        """The time of the last exception that the scenario raised in each obligation."""
        self._takes_time: frozenset[str] = frozenset(getattr(subject, "takes_time", ()))
        self._known: dict[str, Value] = {}
        self._act = 0

    def now(self) -> int:
        """The current second."""
        return second(self._clock.now())

    def step(self, step: Step) -> None:
        """Changes values, and lets triggers occur, at the current time."""
        if step.given:
            self.subject.update(step.given)
            for name, value in step.given.items():
                if value is None:
                    self._known.pop(name, None)
                else:
                    self._known[name] = value
        self.values[self.now()] = dict(self._known)
        if step.when:
            self._trigger(tuple(sorted(step.when)))

    def go_to(self, time: int) -> None:
        """Moves to a time. Everything before it happens; what is due at it is still to come."""
        while (at := self._next()) < time:
            self._happen_at(at)
        self._clock.arrive(time)

    def course(self, end: int) -> Course:
        """What has happened when the second `end` is over."""
        while (at := self._next()) <= end:
            self._happen_at(at)
        raised = [failure.error for failure in getattr(self.subject, "failures", ())]
        if self._loop is None:
            for error in raised:
                if isinstance(error, NeedsAwait):
                    raise error
        return Course(tuple(self.happenings), self.values, end, self._takes_time)

    # Time ---------------------------------------------------------------------------------------------------------

    def _next(self) -> Time:
        """The next time at which something is due."""
        alarm = self._clock.next_alarm()
        times: list[Time] = [at for at, _ in self._due]
        return min(times if alarm is None else (*times, alarm), default=_FOR_EVER)

    def _happen_at(self, at: Time) -> None:
        self._clock.arrive(at)
        self._complete()
        alarm = self._clock.next_alarm()
        if alarm is not None and alarm <= self._clock.now():
            self._perform(partial(self._clock.advance, 0))
            self._complete()

    def _complete(self) -> None:
        """Completes what the scenario completes by now."""
        while due := [one for one in self._due if one[0] <= self._clock.now()]:
            for one in due:
                self._due.remove(one)
                self._completed[one[1]] = one[0]
                self._note("done", one[1], act=self._act + 1)
                self._perform(partial(self.subject.completed, one[1]))  # type: ignore[attr-defined]

    # Acts ---------------------------------------------------------------------------------------------------------

    def _trigger(self, names: tuple[str, ...]) -> None:
        arguments = self._arguments(names) if callable(self._arguments) else self._arguments
        place = len(self.happenings)
        self.happenings.append(Happening(self.now(), "occurs", names, self._act + 1))
        in_turn = getattr(self.subject, "trigger_all_async", None)
        if self._loop is not None and in_turn is not None:
            trigger: Callable[..., object] = partial(in_turn, names)
        elif len(names) == 1:
            trigger = partial(self.subject.trigger, names[0])
        else:
            trigger = partial(self.subject.trigger_all, names)
        self._perform(partial(trigger, *arguments), partial(self._trigger_failed, place))

    def _trigger_failed(self, place: int, error: Exception) -> None:
        one = self.happenings[place]
        started = any(other.act == one.act and other.kind == "starts" for other in self.happenings)
        rejected = isinstance(error, (ConflictInContext, UndeterminedDecision)) and not started
        kind: Kind = "rejected" if rejected else "occurs"
        self.happenings[place] = Happening(one.at, kind, one.names, one.act, error)

    def _perform(self, call: Callable[[], object], failed: Callable[[Exception], object] | None = None) -> None:
        """Makes a call to the subject or the clock, and records what it executes."""
        self._act += 1
        if self._act > _MOST_ACTS:
            raise SleecError(
                f"the robot never comes to rest: {_MOST_ACTS:,} acts at {self.now()} seconds of the scenario",
                "end the chain of responses that triggers itself",
            )
        act = self._act
        report = partial(self._failed, failed)
        with recording(on_execution=partial(self._starts, act), on_end=partial(self._ends, act)), awaited():
            if self._loop is not None:
                self._loop.act(call, report)
                return
            try:
                call()
            except Exception as error:  # noqa: BLE001 - part of what was observed
                report(error)

    def _failed(self, failed: Callable[[Exception], object] | None, error: Exception) -> None:
        if isinstance(error, NeedsAwait) and self._loop is None:
            raise error
        if failed is not None and not _is_withheld(error):
            failed(error)

    def _starts(self, act: int, name: str) -> None:
        self._note("starts", name, act)
        completion = self._completion_of(name)
        if name not in self._takes_time:
            # All executions of one instant have the same result.
            if completion is not None and completion.at is None and self._completed.get(name) != self.now():
                self._withheld[name] = self.now()
            if self._withheld.get(name) == self.now():
                raise WithheldCompletion(name)
        elif completion is None or completion.at is not None:
            at = self.now() if completion is None or completion.at is None else max(completion.at, self.now())
            # Once in a second: what leads back to itself would never come to an end.
            due = max(at, self._completed.get(name, -1) + 1), name
            if due not in self._due:
                self._due.append(due)

    def _completion_of(self, name: str) -> Completion | None:
        """The completion of what starts now: the last one that is due since now or before. Several rules may start one
        obligation at one time."""
        if self._used.get(name, (-1, None))[0] == self.now():
            return self._used[name][1]
        of_name = [one for one in self._completions if one.name == name and one.since <= self.now()]
        found = max(of_name, key=lambda one: one.since, default=None)
        if found is not None:
            self._completions.remove(found)
        self._used[name] = self.now(), found
        return found

    def _ends(self, act: int, name: str, error: BaseException | None) -> None:
        if error is not None:
            self._note("fails", name, act, error)
        elif name not in self._takes_time:
            self._completed[name] = self.now()
            self._note("done", name, act)

    def _note(self, kind: Kind, name: str, act: int, error: BaseException | None = None) -> None:
        self.happenings.append(Happening(self.now(), kind, (name,), act, error))


def _is_withheld(error: BaseException) -> bool:
    """Whether an exception is only what the scenario raised."""
    if isinstance(error, VariantsFailed):
        return all(_is_withheld(each) or isinstance(each, ConflictInContext) for _, each in error.errors)
    return isinstance(error, WithheldCompletion)
