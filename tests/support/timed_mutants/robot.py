"""A robot with deadlines that is written by hand, without the runtime: correct, and small enough to be broken."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sleec_runtime.dispatch.recording import recorded
from sleec_runtime.errors import Prohibited
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset

TEXT = """
CONDITION Alone
CONDITION Raining
MEASURE patience: integer
MEASURE risk: low < middle < high
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 1 minute OTHERWISE CallPolice
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN DustSeen THEN Vacuum
RULE walk WHEN Morning THEN OfferWalk WITHIN 10 TO 60 minutes UNLESS Raining IN WHICH CASE OfferGame WITHIN 10 seconds
RULE ask WHEN Ask THEN Answer WITHIN patience seconds OTHERWISE (Apologise UNLESS Alone IN WHICH CASE Sing)
RULE bell WHEN Bell THEN Open WITHIN 8 seconds
RULE light WHEN Open THEN Light WITHIN 5 TO 9 seconds UNLESS risk = high
RULE either WHEN Choice THEN Left WITHIN 4 seconds ELSE Right WITHIN 8 seconds
RULE guest WHEN Guest THEN Greet EVENTUALLY
DOMAIN ward
RULE alarm WHEN Alarm THEN Report WITHIN 20 seconds
DOMAIN home
RULE alarm_at_home WHEN Alarm THEN CallNeighbour WITHIN 20 seconds
"""
RULES: Ruleset = parse(TEXT)
DOMAIN = "home"
SLOW = frozenset({"CallNurse", "Answer", "Open", "Left", "CallNeighbour"})


@dataclass
class Response:
    """A response, due from `start` to `end` seconds after its trigger; no `end`: at some time."""

    name: str
    start: int = 0
    end: int | None = 0
    otherwise: Response | None = None
    instead: Response | None = None


@dataclass(eq=False)
class Task:
    """A response that is due from `first` to `last`."""

    response: Response
    first: int
    last: int | None
    since: int
    state: str = "waiting"


@dataclass
class Robot:
    """The correct robot. Mutants override a method."""

    clock: Any
    ruleset: Ruleset = RULES
    domain: str = DOMAIN
    takes_time: frozenset[str] = SLOW
    chains: bool = True
    known: dict[str, Any] = field(default_factory=dict)
    tasks: list[Task] = field(default_factory=list)
    bans: list[tuple[str, int, int]] = field(default_factory=list)

    # What the rules say -----------------------------------------------------------------------------------------

    def required(self, trigger: str) -> list[Response]:
        """The responses to a trigger in the current context."""
        reply = {
            "UserFell": self.fell,
            "DustSeen": lambda: [Response("Vacuum")],
            "Morning": self.morning,
            "Ask": self.ask,
            "Bell": lambda: [Response("Open", 0, 8)],
            "Open": lambda: [] if self.known.get("risk") == "high" else [Response("Light", 5, 9)],
            "Choice": lambda: [Response("Left", 0, 4, instead=Response("Right", 0, 8))],
            "Guest": lambda: [Response("Greet", 0, None)],
            "Alarm": self.alarm,
        }.get(trigger)
        return [] if reply is None else reply()

    def fell(self) -> list[Response]:
        police = Response("CallPolice")
        return [Response("CallNurse", 0, 300, Response("CallAmbulance", 0, 60, police))]

    def morning(self) -> list[Response]:
        return [Response("OfferGame", 0, 10)] if self.known.get("Raining") else [Response("OfferWalk", 600, 3600)]

    def ask(self) -> list[Response]:
        return [Response("Answer", 0, self.patience(), self.excuse())]

    def patience(self) -> int:
        return int(self.known["patience"])

    def excuse(self) -> Response:
        return Response("Sing" if self.known.get("Alone") else "Apologise")

    def alarm(self) -> list[Response]:
        return [Response("CallNeighbour", 0, 20)]

    def forbidden(self, trigger: str) -> list[tuple[str, int, int]]:
        """What a trigger forbids, from when to when after it."""
        return [("Vacuum", 0, 3600)] if trigger == "UserSleeps" else []

    # The interface of a subject ---------------------------------------------------------------------------------

    def update(self, changes: Mapping[str, object]) -> None:
        for name, value in changes.items():
            if value is None:
                self.known.pop(name, None)
            else:
                self.known[name] = value

    def trigger(self, name: str) -> None:
        self.trigger_all([name])

    def trigger_all(self, names: Iterable[str]) -> None:
        names = list(names)
        bans = [ban for name in names for ban in self.forbidden(name)]
        wanted = [response for name in names for response in self.required(name)]
        now = self.clock.now()
        for response in wanted:
            if response.start == 0 and (
                self.is_banned(response.name) or any(ban == response.name and not first for ban, first, _ in bans)
            ):
                raise Prohibited(f"{response.name} is forbidden", response.name, None, "nothing was executed")
        self.bans += [(name, now + first, now + last) for name, first, last in bans]
        for response in wanted:
            self.begin(response, now)

    def completed(self, name: str) -> None:
        self.happened(name)

    # Deadlines --------------------------------------------------------------------------------------------------

    def is_banned(self, name: str) -> bool:
        now = self.clock.now()
        return any(ban == name and first <= now <= last for ban, first, last in self.bans)

    def begin(self, response: Response, due: int) -> None:
        """A response is due from the time `due` on."""
        last = None if response.end is None else due + response.end
        task = Task(response, due + response.start, last, self.clock.now())
        self.tasks.append(task)
        self.at(self.starting_time(task), lambda: self.start(task))
        if task.last is not None and task.state == "waiting":
            self.at(self.closing_time(task), lambda: self.close(task))

    def starting_time(self, task: Task) -> int:
        return task.first

    def closing_time(self, task: Task) -> int:
        assert task.last is not None
        return task.last

    def at(self, time: int, act: Callable[[], object]) -> None:
        if time <= self.clock.now():
            act()
        else:
            self.clock.wake(time, act)

    def start(self, task: Task) -> None:
        if task.state == "waiting" or self.repeats(task):
            try:
                self.do(task.response.name)
            except Exception:  # noqa: BLE001 - the deadline shows that it failed
                task.state = "failed"
            else:
                if task.response.name not in self.takes_time:
                    self.happened(task.response.name)
            if task.last is not None and task.last > self.clock.now() and task.state != "done":
                task.state = "under way" if task.state == "waiting" else task.state
                self.at(self.closing_time(task), lambda: self.close(task))
            elif task.state == "failed":
                self.close(task)

    def repeats(self, task: Task) -> bool:
        return False

    def do(self, name: str) -> None:
        """Executes an obligation."""
        recorded(name, lambda: None)()

    def happened(self, name: str) -> None:
        """An obligation is done."""
        now = self.clock.now()
        for task in list(self.tasks):
            if task.response.name == name and self.discharges(task, now):
                task.state = "done"
        self.follow(name)

    def follow(self, name: str) -> None:
        for response in self.required(name):
            self.begin(response, self.clock.now())

    def discharges(self, task: Task, now: int) -> bool:
        return task.first <= now and (task.last is None or now <= task.last)

    def close(self, task: Task) -> None:
        """The window of a task closes."""
        if task.state in ("done", "closed"):
            return
        task.state = "closed"
        self.missed(task)

    def missed(self, task: Task) -> None:
        following = task.response.otherwise
        if following is not None:
            self.begin(following, self.clock.now())
        elif task.response.instead is not None:
            self.begin_instead(task.response.instead, task)

    def begin_instead(self, response: Response, task: Task) -> None:
        last = None if response.end is None else task.since + response.end
        if last is None or last >= self.clock.now():
            other = Task(response, self.clock.now(), last, task.since)
            self.tasks.append(other)
            self.start(other)
