"""The thing under test: anything that takes changes of context and triggers, watched while it executes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

from sleec_runtime.dispatch.implementations import watched
from sleec_runtime.dispatch.recording import recording
from sleec_runtime.errors import NeedsAwait, SleecError
from sleec_runtime.model import Context, Reading, Ruleset, Value
from sleec_verify.conformance.oracle import Oracle


@runtime_checkable
class Subject(Protocol):
    """What can be tested. A `sleec_runtime.Sleec` is one; so is whatever else has these four."""

    @property
    def ruleset(self) -> Ruleset:
        """The rules in force."""
        ...

    def update(self, changes: Mapping[str, object]) -> object:
        """One change of context; None says that a value is no longer known."""
        ...

    def trigger(self, name: str, /, *args: Any) -> object: ...

    def trigger_all(self, names: Iterable[str], /, *args: Any) -> object:
        """Several triggers at once, in one context."""
        ...


Factory = Callable[[], Any]
"""Makes a new subject each time, with its code bound and nothing reported yet."""

Arguments = Sequence[object] | Callable[[tuple[str, ...]], Sequence[object]]
"""What triggers are called with: the same always, or depending on the triggers that occur."""


class NotASubject(SleecError):
    """A factory that did not make what can be tested."""


@dataclass(frozen=True)
class Observation:
    """What one dispatch did: what was executed, in order, and what it raised."""

    executed: tuple[str, ...]
    failed: tuple[str, ...] = ()
    error: BaseException | None = None


@dataclass(frozen=True)
class Bench:
    """What to test, and against which rules.

    `ruleset` is what the subject must obey, in `domain` and `reading`; where it is None, the subject's own. `watch` are
    further objects and modules whose methods implement obligations. `arguments` are those of every trigger.
    """

    make: Factory
    ruleset: Ruleset | None = None
    domain: str | None = None
    reading: Reading | None = None
    watch: tuple[object, ...] = ()
    arguments: Arguments = ()
    _oracles: dict[str | None, Oracle] = field(default_factory=dict, init=False, repr=False, compare=False)

    def oracle(self) -> Oracle:
        """What must be done, compiled once for all subjects of this bench."""
        if None not in self._oracles:
            subject = self.subject()
            whole = self.ruleset if self.ruleset is not None else whole_ruleset(subject)
            if self.reading is not None:
                whole = whole.read_as(self.reading)
            domain = self.domain if self.domain is not None else getattr(subject, "domain", None)
            self._oracles[None] = Oracle(whole, domain)
        return self._oracles[None]

    def subject(self) -> Subject:
        """A new subject. Raises NotASubject, and whatever the factory raises."""
        made = self.make()
        if not isinstance(made, Subject):
            raise NotASubject(
                f"the factory returned {_described(made)}, which is not a Sleec",
                "return the Sleec of the robot, as made by sleec_runtime.load",
            )
        return made

    @contextmanager
    def running(self) -> Iterator[Running]:
        """A new subject, watched until the end of the block."""
        subject = self.subject()
        objects: list[object] = getattr(subject, "bound_objects", list)()
        with ExitStack() as stack:
            for robot in {id(robot): robot for robot in (*objects, *self.watch)}.values():
                stack.enter_context(watched(robot, self.oracle().whole.obligations))
            yield Running(subject, self.oracle(), self.arguments)


class Running:
    """A subject, what it was told of the context so far, and what it must do."""

    def __init__(self, subject: Subject, oracle: Oracle, arguments: Arguments) -> None:
        self.subject = subject
        self.oracle = oracle
        self._arguments = arguments
        self.known: dict[str, Value] = {}

    def change(self, changes: Mapping[str, Value | None]) -> None:
        """One change, as it is given to the subject."""
        self.subject.update(changes)
        self.note(changes)

    def note(self, changes: Mapping[str, Value | None]) -> None:
        """Remembers a change that the subject was told of otherwise."""
        for name, value in changes.items():
            if value is None:
                self.known.pop(name, None)
            else:
                self.known[name] = value

    def enter(self, context: Context) -> None:
        """One change that leads from what is known to the conditions of `context`."""
        changes = self.way_to(context)
        if changes:
            self.change(changes)

    def way_to(self, context: Context) -> dict[str, Value | None]:
        wanted = context.conditions
        changes: dict[str, Value | None] = dict.fromkeys(name for name in self.known if name not in wanted)
        for name, value in wanted.items():
            if name not in self.known or self.known[name] != value:
                changes[name] = value
        return changes

    def here(self, triggers: Iterable[str]) -> Context:
        """The context of now, with `triggers` occurring in it."""
        return Context(frozenset(triggers), dict(self.known))

    def observe(self, triggers: Iterable[str], on_execution: Callable[[str], object] | None = None) -> Observation:
        """What the subject does if these occur now. `on_execution` is called as each obligation begins."""
        names = tuple(sorted(triggers))
        arguments = self._arguments(names) if callable(self._arguments) else self._arguments
        error: BaseException | None = None
        meanwhile = False

        def between(name: str) -> None:
            nonlocal meanwhile
            if on_execution is None or meanwhile:
                return
            meanwhile, before = True, len(seen.executed)
            try:
                on_execution(name)
            finally:
                # What another dispatch executed in the midst of this one is not of this one.
                del seen.executed[before:]
                meanwhile = False

        with recording(on_execution=between) as seen:
            try:
                self._dispatch(names, arguments)
            except Exception as raised:  # noqa: BLE001 - part of what was observed
                error = raised
        return Observation(tuple(seen.executed), tuple(seen.failed), error)

    def _dispatch(self, names: tuple[str, ...], arguments: Sequence[object]) -> None:
        try:
            if len(names) == 1:
                self.subject.trigger(names[0], *arguments)
            else:
                self.subject.trigger_all(names, *arguments)
        except NeedsAwait:
            in_turn = getattr(self.subject, "trigger_all_async", None)
            if in_turn is None:
                raise
            import asyncio

            asyncio.run(in_turn(names, *arguments))


def whole_ruleset(subject: Subject) -> Ruleset:
    """The rules of a subject with all their domains, as far as it tells of them."""
    hold = getattr(subject, "hold", None)
    if hold is None:
        return subject.ruleset
    found: list[Ruleset] = []
    hold(lambda snapshot: found.append(snapshot.index.whole))
    return found[0]


def _described(made: object) -> str:
    return "nothing" if made is None else f"a {type(made).__name__}"
