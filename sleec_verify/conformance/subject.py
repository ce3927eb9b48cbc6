"""The subject of a test: anything that accepts changes of context and triggers, observed while it executes."""

from __future__ import annotations

import contextvars
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any, Protocol, cast, runtime_checkable

from sleec_runtime import VirtualClock
from sleec_runtime.dispatch.recording import recording
from sleec_runtime.errors import NeedsAwait, NotEnforced, SleecError
from sleec_runtime.model import Context, Reading, Ruleset, Value, constructs
from sleec_verify.conformance.instrumentation import instrumented, robots_of
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.conformance.other_threads import awaited, followed

if TYPE_CHECKING:
    import asyncio


@runtime_checkable
class Subject(Protocol):
    """The interface of a subject. A `sleec_runtime.Sleec` is one."""

    @property
    def ruleset(self) -> Ruleset:
        """The current rules."""
        ...

    def update(self, changes: Mapping[str, object]) -> object:
        """One change of context. None says that a value is no longer known."""
        ...

    def trigger(self, name: str, /, *args: Any) -> object: ...

    def trigger_all(self, names: Iterable[str], /, *args: Any) -> object:
        """Several triggers at once, in one context."""
        ...


Factory = Callable[..., Any]
"""Creates a new subject at each call, with its code bound and no context reported. A factory with a parameter `clock`,
or with one required parameter, gets the clock of the test, which the subject must use."""

Arguments = Sequence[object] | Callable[[tuple[str, ...]], Sequence[object]]
"""The arguments of triggers: constant, or a function of the triggers that occur."""


class NotASubject(SleecError):
    """A factory that did not create a subject."""


@dataclass(frozen=True)
class Observation:
    """The result of one dispatch: the executed obligations, in order, and the exception, if any."""

    executed: tuple[str, ...]
    failed: tuple[str, ...] = ()
    error: BaseException | None = None


@dataclass
class _Memory:
    """What a bench has found out about its factory."""

    takes_clock: bool | None = None
    kind: type | None = None
    asynchronous: bool = False


@dataclass(frozen=True)
class Bench:
    """What to test, and against which rules.

    `ruleset` is what the subject must follow, in `domain` and `reading`; None for the subject's own. `watch` are
    further objects and modules whose methods implement obligations. `arguments` are those of every trigger.
    """

    make: Factory
    ruleset: Ruleset | None = None
    domain: str | None = None
    reading: Reading | None = None
    watch: tuple[object, ...] = ()
    arguments: Arguments = ()
    _oracles: dict[str | None, Oracle] = field(default_factory=dict, init=False, repr=False, compare=False)
    _memory: _Memory = field(default_factory=_Memory, init=False, repr=False, compare=False)

    def oracle(self) -> Oracle:
        """What must be executed, compiled once for all subjects of this bench."""
        if None not in self._oracles:
            self._oracles[None] = Oracle(*self.rules())
        return self._oracles[None]

    def rules(self) -> tuple[Ruleset, str | None]:
        """The ruleset that the subject must follow, with all its domains, and the domain."""
        subject = self._looked_at()
        whole = self.ruleset if self.ruleset is not None else whole_ruleset(subject)
        if self.reading is not None:
            whole = whole.read_as(self.reading)
        return whole, self.domain if self.domain is not None else getattr(subject, "domain", None)

    def chains(self) -> bool:
        """Whether a response of the subject triggers the rules of its name."""
        return bool(getattr(self._looked_at(), "chains", True))

    def _looked_at(self) -> Subject:
        """A new subject, to read its rules."""
        try:
            return self.subject()
        except RuntimeError as error:
            if not needs_running_loop(error):
                raise
            import asyncio

            async def within() -> Subject:
                return self.subject()

            return asyncio.run(within())

    @property
    def asynchronous(self) -> bool:
        """Whether code of the subject was found to need an event loop."""
        return self._memory.asynchronous

    def needs_loop(self) -> None:
        """Records that code of the subject needs an event loop."""
        self._memory.asynchronous = True

    def subject(self, clock: VirtualClock | None = None) -> Subject:
        """A new subject, on `clock` if its factory takes one. Raises `NotASubject`, and the exceptions of the
        factory."""
        with warnings.catch_warnings():
            # What the runtime does not enforce is part of the test.
            warnings.simplefilter("ignore", NotEnforced)
            if self._memory.takes_clock is None:
                self._memory.takes_clock = takes_clock(self.make)
            wanted = (VirtualClock() if clock is None else clock,) if self._memory.takes_clock else ()
            made = self.make(*wanted)
        # The look at a protocol is slow, and a factory makes one type.
        if type(made) is self._memory.kind:
            return cast(Subject, made)
        if not isinstance(made, Subject):
            raise NotASubject(
                f"the factory returned {_described(made)}, which is not a Sleec",
                "return the Sleec of the robot, as made by sleec_runtime.load",
            )
        self._memory.kind = type(made)
        return made

    @contextmanager
    def running(self) -> Iterator[Running]:
        """A new subject, observed until the end of the block."""
        oracle = self.oracle()
        with self.observed(self.subject(), oracle.whole.obligations) as subject:
            yield Running(subject, oracle, self.arguments)

    @contextmanager
    def observed(self, subject: Subject, obligations: Iterable[str]) -> Iterator[Subject]:
        """A subject, of which recordings see each execution of `obligations` until the end of the block."""
        objects: list[object] = getattr(subject, "bound_objects", list)()
        given: list[object] = getattr(subject, "implementing", list)()
        with followed(), instrumented((*objects, *given, *robots_of(given), *self.watch), obligations):
            yield subject


class Running:
    """A subject, the context that was reported to it, and what it must execute."""

    def __init__(self, subject: Subject, oracle: Oracle, arguments: Arguments) -> None:
        self.subject = subject
        self.oracle = oracle
        self._arguments = arguments
        self.known: dict[str, Value] = {}
        self._within: list[asyncio.Task[None]] = []

    def change(self, changes: Mapping[str, Value | None]) -> None:
        """One change, which is also reported to the subject."""
        self.subject.update(changes)
        self.note(changes)

    def note(self, changes: Mapping[str, Value | None]) -> None:
        """Records a change that was reported to the subject in another way."""
        for name, value in changes.items():
            if value is None:
                self.known.pop(name, None)
            else:
                self.known[name] = value

    def enter(self, context: Context) -> None:
        """One change from the current context to the conditions of `context`."""
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
        """The current context, with `triggers`."""
        return Context(frozenset(triggers), dict(self.known))

    def observe(self, triggers: Iterable[str], on_execution: Callable[[str], object] | None = None) -> Observation:
        """What the subject does if these triggers occur now. `on_execution` is called at the start of each
        obligation."""
        names = tuple(sorted(triggers))
        arguments = self._arguments_of(names)
        error: BaseException | None = None
        meanwhile = False

        def between(name: str) -> object:
            nonlocal meanwhile
            if on_execution is None or meanwhile:
                return None
            meanwhile, before = True, len(seen.executed)
            try:
                return on_execution(name)
            finally:
                # Executions of a nested dispatch do not belong to this one.
                del seen.executed[before:]
                meanwhile = False

        with recording(on_execution=between) as seen, awaited():
            try:
                self._dispatch(names, arguments)
            except Exception as raised:  # noqa: BLE001 - part of what was observed
                error = raised
        return Observation(tuple(seen.executed), tuple(seen.failed), error)

    def observe_within(
        self, triggers: Iterable[str], then: Callable[[Observation], object]
    ) -> asyncio.Task[None] | None:
        """These triggers occur while an obligation is executed. `then` gets what the subject does: now, or in an event
        loop when the returned task has run, which a coroutine of the robot awaits."""
        loop = running_loop()
        if loop is None:
            then(self.observe(triggers))
            return None
        names = tuple(sorted(triggers))

        async def observed() -> None:
            error: BaseException | None = None
            with recording() as seen:
                try:
                    await self._dispatch_in_loop(names, self._arguments_of(names))
                except Exception as raised:  # noqa: BLE001 - part of what was observed
                    error = raised
            then(Observation(tuple(seen.executed), tuple(seen.failed), error))

        # In an empty context, the outer recording does not see what is executed.
        task = contextvars.Context().run(loop.create_task, observed())
        self._within.append(task)
        return task

    def _arguments_of(self, names: tuple[str, ...]) -> Sequence[object]:
        return self._arguments(names) if callable(self._arguments) else self._arguments

    def _dispatch(self, names: tuple[str, ...], arguments: Sequence[object]) -> None:
        try:
            if len(names) == 1:
                self.subject.trigger(names[0], *arguments)
            else:
                self.subject.trigger_all(names, *arguments)
        except NeedsAwait:
            if getattr(self.subject, "trigger_all_async", None) is None:
                raise
            import asyncio

            asyncio.run(self._dispatch_in_loop(names, arguments))

    async def _dispatch_in_loop(self, names: tuple[str, ...], arguments: Sequence[object]) -> None:
        subject: Any = self.subject
        within, self._within = self._within, []
        try:
            await subject.trigger_all_async(names, *arguments)
        finally:
            # Triggers within code that is not asynchronous wait for the loop.
            for task in self._within:
                await task
            self._within = within


def running_loop() -> asyncio.AbstractEventLoop | None:
    """The running event loop of this thread, if there is one. It does not import asyncio."""
    module = sys.modules.get("asyncio")
    if module is None:
        return None
    try:
        loop: asyncio.AbstractEventLoop = module.get_running_loop()
    except RuntimeError:
        return None
    return loop


def is_timed(bench: Bench) -> bool:
    """Whether the rules of a bench have times or relations."""
    return any(True for _ in constructs(bench.rules()[0]))


def takes_clock(make: Factory) -> bool:
    """Whether a factory has a parameter `clock`, or a required positional parameter."""
    try:
        parameters = list(signature(make).parameters.values())
    except (TypeError, ValueError):
        return False
    positional = [one for one in parameters if one.kind in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD)]
    return bool(positional) and (positional[0].default is Parameter.empty or positional[0].name == "clock")


def needs_running_loop(error: RuntimeError) -> bool:
    """Whether a factory failed because it runs outside of an event loop."""
    return "no running event loop" in str(error)


def whole_ruleset(subject: Subject) -> Ruleset:
    """The rules of a subject with all their domains, if it provides them."""
    hold = getattr(subject, "hold", None)
    if hold is None:
        return subject.ruleset
    found: list[Ruleset] = []
    hold(lambda snapshot: found.append(snapshot.index.whole))
    return found[0]


def _described(made: object) -> str:
    return "nothing" if made is None else f"a {type(made).__name__}"
