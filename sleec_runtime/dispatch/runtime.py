"""The runtime's face: a ruleset at work."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from sleec_runtime.concurrency.critical_section import CriticalSection, exclusive
from sleec_runtime.dispatch import arguments
from sleec_runtime.dispatch.dispatch import Done, Plan, cell_of, due_in, plan, run, run_async
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.layers import Layers
from sleec_runtime.dispatch.program import Program
from sleec_runtime.dispatch.snapshot import Conditions, Snapshot
from sleec_runtime.errors import NotBound, SleecError, UnknownObligation, UnknownTrigger
from sleec_runtime.evaluation.evaluation import Due, broken_assumptions
from sleec_runtime.model import Assume, Measure, Reading, Rule, Ruleset
from sleec_runtime.support.messages import listed

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType

    from sleec_runtime.certificate.coverage import Demand
    from sleec_runtime.dispatch.global_activation import GlobalActivation
    from sleec_runtime.dispatch.monitor import Monitor
    from sleec_runtime.timed.clocks import Clock, MonotonicClock, Time
    from sleec_runtime.timed.failures import Failure
    from sleec_runtime.timed.pending import Pending
    from sleec_runtime.timed.scheduler import Timekeeper

F = TypeVar("F")

Listener = Callable[["Snapshot", "Snapshot", "tuple[Rule, ...]"], None]
"""Told of each change: the context before, the one after, and the rules that were decided anew."""


class Sleec:
    """A CO-SLEEC instance (paper, Section 3.2) with the context that it is in.

    Any thread may call anything at any time. A dispatch reads one reference and never waits; changes take a lock.
    `strict` makes a decision that depends on unreported conditions an error; without it they are false
    (Definition 1). `domain` leaves out the rules of other domains; `reading` goes before the ruleset's own.

    For rules with times (docs/runtime.md): `clock` counts their windows, by default the computer's own, with a thread
    while there is something to watch. With `chains`, a response that is done is an event and triggers the rules of
    that name. `on_error` is told of each `Failure` of what the clock started; without it, the log is. What the runtime
    does not enforce is named by a NotEnforced warning, or with `strict_times` by UnsupportedTimes.

    With `certificate`, the folder of one, only rules are ever in force that it, or another one given to `replace`,
    proves free of conflict as they are used. With `key`, the file of a public key, it must be signed; with
    `require_proved` or `require_tied`, made with these options (docs/certificates.md). Else: CertificateRefused.
    """

    def __init__(
        self,
        ruleset: Ruleset,
        domain: str | None = None,
        reading: Reading | None = None,
        strict: bool = False,
        *,
        clock: Clock | None = None,
        chains: bool = False,
        on_error: Callable[[Failure], object] | None = None,
        strict_times: bool = False,
        certificate: str | Path | None = None,
        key: str | Path | None = None,
        require_proved: bool = False,
        require_tied: bool = False,
    ) -> None:
        whole = arguments.ruleset(ruleset, reading)
        required = {"require_proved": require_proved, "require_tied": require_tied}
        arguments.check_choices(strict=strict, chains=chains, strict_times=strict_times, **required)
        program = Program(whole, domain, strict)
        self._demand = arguments.demand(certificate, chains, key, **required)
        if self._demand is not None:
            self._demand.check(whole, domain)
        self._reading = reading
        self._strict = strict
        self._chains = chains
        self._strict_times = strict_times
        arguments.check_clock(clock)
        self._clock = clock
        self._own_clock: MonotonicClock | None = None
        self._on_error = on_error
        self._times: Timekeeper | None = None
        self._section = CriticalSection()
        self._listeners: list[Listener] = []
        self._objections: list[Listener] = []
        self._monitor: Monitor | None = None
        self._snapshot = Snapshot.first(program, {})
        self._instance = Instance(whole)
        self._times = self._timekeeper(self._snapshot.program)

    # What there is --------------------------------------------------------------------------------------

    @property
    def ruleset(self) -> Ruleset:
        """The rules in force: those of the domain, under the reading."""
        return self._snapshot.program.ruleset

    @property
    def domain(self) -> str | None:
        return self._snapshot.program.domain

    @property
    def layers(self) -> Layers:
        """L: the layers by name, for ``@cop.around(sleec.layers["dress_assist.hc1"])``. Raises UnknownLayer."""
        return self._instance.layers

    @property
    def conditions(self) -> Conditions:
        """What is known now, as one whole context: it does not change under its reader."""
        return self._snapshot.conditions

    @property
    def vocabulary(self) -> Mapping[str, Measure | None]:
        """What `update` takes: the conditions, with None, and the measures, each with its declaration."""
        return self._snapshot.program.vocabulary

    # Code for the rules ---------------------------------------------------------------------------------

    def rule(self, label: str) -> Callable[[F], F]:
        """Marks a method as the one of rule `label`, MM(R); goes above its ``@cop.base``. Raises UnknownLabel."""
        return self._instance.mark(label)

    @exclusive
    def bind(self, *targets: object) -> None:
        """Makes the marked methods of objects, classes, modules or functions those of their rules: all, or none.

        A method's variants are read here, so bind when all are there. Raises Unbindable if a target has no marked
        method, if variants of one are not each on a layer of their own rule, and, under global activation, if a plain
        call would not dispatch it; AlreadyBound for a second method of a rule.
        """
        with self._instance.kept_on_failure():
            labels = self._instance.bind(targets, self.ruleset.rules if self.activated_globally else ())
            self._watch_bound(self._instance, self._snapshot.program)
            self._plan_anew(labels)

    @exclusive
    def unbind(self, *labels: str) -> None:
        """Takes their methods from rules. Dispatches under way finish with them. Raises UnknownLabel."""
        with self._instance.kept_on_failure():
            self._instance.unbind(labels)
            self._plan_anew(labels)

    @exclusive
    def implement(self, target: object) -> None:
        """Gives a callable to each of some obligations; rules without a method run these, in the order of the clause.

        `target` maps names to callables, or is an object or module whose callables are marked with
        ``@sleec_runtime.obligation("OpenCurtains")`` or named in snake case. Each is called with the arguments of the
        trigger. Raises UnknownObligation, and Unbindable for what is not callable or implements nothing.
        """
        with self._instance.kept_on_failure():
            self._instance.implement(target, self._snapshot.program.whole.obligations)
            self._plan_anew(rule.label for rule in self.ruleset.rules)

    def missing(self) -> Mapping[str, NotBound]:
        """The rules that could not run in some context, with why. Empty when all code is there. O(clauses)."""
        return self._instance.missing(self.ruleset.rules)

    # Context --------------------------------------------------------------------------------------------

    @exclusive
    def update(self, changes: Mapping[str, object]) -> None:
        """One change of context, whole or not at all: no dispatch sees part of it.

        None says that a condition is no longer known. O(changes + size of the rules that mention them). Raises
        UnknownCondition or WrongType, under global activation ConflictInContext or UndeterminedDecision too, and then
        nothing has changed.
        """
        before = self._snapshot
        after, rules = before.changed(changes)
        if after is not before:
            self._object(before, after, rules)
            self._snapshot = after
            self._tell(before, after, rules)

    def broken_assumptions(self, *triggers: str) -> tuple[Assume, ...]:
        """The assumptions that the context breaks, if `triggers` occur in it.

        What was proved of the rules was proved of contexts that break none, so a robot that finds one broken has reason
        to distrust its sensors. Rules decide in such a context as in any other. Raises UnknownTrigger.
        """
        snapshot = self._snapshot
        for trigger in triggers:
            cell_of(snapshot, trigger)
        return broken_assumptions(snapshot.program.ruleset, snapshot.context(triggers))

    # Triggers -------------------------------------------------------------------------------------------

    def trigger(self, name: str, /, *args: Any, **kwargs: Any) -> Done:
        """The trigger occurs: decides every rule of it in one context, and runs the variants, each with the arguments.

        All that can be refused is refused before anything runs: UnknownTrigger, NotBound, UndeterminedDecision (in
        strict mode), ConflictInContext, WrongArguments, NeedsAwait. A variant that raises does not keep those of other
        rules from running; what it raised is raised after them (VariantsFailed holds several). O(rules of the trigger)
        the first time in a context, then O(rules that speak), however many others are loaded.
        """
        snapshot = self._snapshot
        if self._times is not None:
            return self._times.trigger((name,), args, kwargs, self._monitor)
        ready = self._ready(snapshot, name)
        monitor = self._monitor
        return (run if monitor is None else monitor.run)(ready, snapshot, args, kwargs)

    def trigger_all(self, names: Iterable[str], /, *args: Any, **kwargs: Any) -> Done:
        """Several triggers occur at once: one context, the rules of all in their order. Otherwise as `trigger`."""
        snapshot = self._snapshot
        if self._times is not None:
            return self._times.trigger(arguments.triggers(names), args, kwargs, self._monitor)
        ready = plan(snapshot, arguments.triggers(names), self._instance)
        monitor = self._monitor
        return (run if monitor is None else monitor.run)(ready, snapshot, args, kwargs)

    async def trigger_async(self, name: str, /, *args: Any, **kwargs: Any) -> Done:
        """`trigger`, where variants may be coroutine functions: they are awaited one after the other. The context is
        that of the moment when this is first awaited."""
        snapshot = self._snapshot
        if self._times is not None:
            return await self._times.trigger_async((name,), args, kwargs, self._monitor)
        ready = self._ready(snapshot, name)
        monitor = self._monitor
        return await (run_async if monitor is None else monitor.run_async)(ready, snapshot, args, kwargs)

    async def trigger_all_async(self, names: Iterable[str], /, *args: Any, **kwargs: Any) -> Done:
        """`trigger_all`, where variants may be coroutine functions."""
        snapshot = self._snapshot
        if self._times is not None:
            return await self._times.trigger_async(arguments.triggers(names), args, kwargs, self._monitor)
        ready = plan(snapshot, arguments.triggers(names), self._instance)
        monitor = self._monitor
        return await (run_async if monitor is None else monitor.run_async)(ready, snapshot, args, kwargs)

    def due(self, *names: str) -> Due:
        """What would be due if these triggers occurred now; nothing is run, and no code need be bound. Raises as
        `trigger` does, but for what concerns code."""
        snapshot = self._snapshot
        if self._times is not None:
            return self._times.due(names)
        return due_in(snapshot, names)

    # Times ----------------------------------------------------------------------------------------------

    def completed(self, obligation: str) -> tuple[Pending, ...]:
        """Something that takes time is done, now. Returns the pending obligations that this fulfils.

        With `chains`, it also triggers the rules of that name, with the arguments of the trigger that asked for it.
        Raises UnknownObligation; Prohibited if a rule forbids it now, which does not undo it; and what triggering
        raises.
        """
        obligations = self._snapshot.program.whole.obligations
        if not isinstance(obligation, str):
            raise UnknownObligation(obligation, obligations)
        if self._times is not None:
            return self._times.completed(obligation)
        if obligation not in obligations:
            raise UnknownObligation(obligation, obligations)
        return ()

    def pending(self) -> tuple[Pending, ...]:
        """All that was asked for and is not over, by when it ends: obligations that are still to be done, and
        prohibitions that are still in force, of rules that have been replaced since, too."""
        return () if self._times is None else self._times.pending()

    @property
    def failures(self) -> tuple[Failure, ...]:
        """What went wrong with what the clock started, and deadlines that were missed: the last thousand, in order."""
        return () if self._times is None else self._times.failures.kept()

    def pending_snapshot(self, now: Time | None = None) -> dict[str, Any]:
        """What `pending` lists, as plain data for `json.dump`: another process can `restore` it after this one ended.

        `now` is the time in seconds since 1970; without it, that of the computer. The arguments of triggers are
        included where code may still be called with them. O(pending). Raises WrongType for one of these that is not
        plain data, and SnapshotRefused for rules that were not read from a text.
        """
        saved_at = arguments.world_time(now)
        if self._times is not None:
            return self._times.snapshot(saved_at)
        from sleec_runtime.timed.checkpoint import checkpoint

        return checkpoint((), self._snapshot.program, self._chains, 0, saved_at)

    def restore(self, snapshot: Mapping[str, Any], now: Time | None = None) -> tuple[Pending, ...]:
        """Goes on with what was pending when another process took `snapshot`; returns what is pending now.

        Give the code and the context first, and trigger nothing before. What was to be started since then is started
        now. What is under way stays so. A deadline that has passed since then is missed now: what stands behind
        ``OTHERWISE`` is started, or `failures` gets a DeadlineMissed. `now` is as in `pending_snapshot`.

        Raises SnapshotRefused for a snapshot that is malformed, of other rules or another reading or domain, from a
        later time, or restored already; NotBound and WrongArguments if the code does not fit. Nothing has changed then.
        """
        world = arguments.world_time(now)
        if self._times is not None:
            return self._times.restore(snapshot, world)
        from sleec_runtime.timed.recovery import Heir, recover

        recover(snapshot, Heir(self._snapshot.program, self._instance, self._chains, 0, world))
        return ()

    def tick(self) -> None:
        """Starts and ends all that is due by now; for a clock that wakes nobody. What goes wrong is in `failures`, and
        not raised, except a KeyboardInterrupt in the main thread."""
        if self._times is not None:
            self._times.tick()

    def close(self) -> None:
        """Ends the watching of windows, and the thread of the default clock. It waits for code that this clock runs, up
        to the limit of the clock. What is pending stays so; a trigger that would bring more of it raises SleecError.
        ``with sleec:`` does this at its end."""
        if self._times is not None:
            self._times.close()
        if self._own_clock is not None:
            self._own_clock.close()

    def __enter__(self) -> Sleec:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # Other rules, other modes ---------------------------------------------------------------------------

    @exclusive
    def prepare(self, ruleset: Ruleset) -> None:
        """Makes the labels and layers of `ruleset` known, so that methods can be written for it before `replace`."""
        self._instance.admit(arguments.ruleset(ruleset, self._reading))

    def replace(
        self,
        ruleset: Ruleset,
        *,
        bind: Iterable[object] = (),
        implement: object = None,
        certificate: str | Path | None = None,
    ) -> None:
        """Puts other rules in force, at once for all triggers; those under way finish under the old ones.

        Layers of equal name stay the objects that they are, methods stay bound by label, and what is known of the
        context stays known. `bind` and `implement` bring the code for new rules. Raises NotBound if a rule would be
        without code that was not without before, WrongType if a known value does not fit the new declarations, and
        what `bind` and `implement` raise: then nothing has changed. An instance with a certificate needs `certificate`
        for them, signed by the same key if it has one, and raises CertificateRefused.
        """
        self._replace(arguments.ruleset(ruleset, self._reading), tuple(bind), implement, certificate)

    @exclusive
    def _replace(
        self, whole: Ruleset, bind: tuple[object, ...], implement: object, certificate: str | Path | None
    ) -> None:
        demand = self._demand
        if certificate is not None:
            demand = arguments.demand(certificate, self._chains) if demand is None else demand.of(certificate)
        instance = self._instance.copied()
        instance.admit(whole)
        instance.bind(bind)
        if implement is not None:
            instance.implement(implement, whole.obligations)
        self._install(Program(whole, self.domain, self._strict), instance, demand)

    @exclusive
    def enter_domain(self, domain: str | None) -> None:
        """Puts the rules of another domain in force, as `replace` does. Raises UnknownDomain, and CertificateRefused
        where there is a certificate, and not for this domain."""
        program = Program(self._snapshot.program.whole, domain, self._strict)
        self._install(program, self._instance, self._demand)

    def activate_globally(self) -> GlobalActivation:
        """The paper's own mode (Section 4): from now on the layers of the active clauses are globally active, so that
        methods can be called without a trigger. See `GlobalActivation` for what that costs and where it is wrong.
        Raises UnsupportedTimes for rules with times, because nothing would be watched."""
        from sleec_runtime.dispatch.global_activation import GlobalActivation

        return GlobalActivation(self).start()

    # For the modules of the runtime ---------------------------------------------------------------------

    def listen(self, listener: Listener, objection: Listener | None = None) -> Callable[[], None]:
        """Has `listener` told of every change of context, before the next one can come; returns what ends it. An
        `objection` is asked before anything changes, and what it raises keeps all as it is."""
        self._listeners.append(listener)
        if objection is not None:
            self._objections.append(objection)

        def end() -> None:
            self._listeners.remove(listener)
            if objection is not None:
                self._objections.remove(objection)

        return end

    @exclusive
    def hold(self, act: Callable[[Snapshot], None]) -> None:
        """Calls `act` with the context of now, which does not change meanwhile: changes wait, dispatches do not."""
        act(self._snapshot)

    def attach(self, monitor: Monitor) -> None:
        """Lets `monitor` run every dispatch; to be called within `hold`. Raises SleecError if another does."""
        if self._monitor is not None:
            raise SleecError("a monitor is on already", "stop() it first")
        self._monitor = monitor

    def detach(self, monitor: Monitor) -> None:
        """Ends that."""
        if self._monitor is monitor:
            self._monitor = None

    @property
    def activated_globally(self) -> bool:
        """Whether plain calls of bound methods are dispatched: nothing else has objections to changes."""
        return bool(self._objections)

    def allow_calls(self) -> None:
        """Sees to it that ContextPy3 dispatches bound methods as this runtime does. Raises Unbindable for one that it
        would not."""
        self._instance.allow_calls(self.ruleset.rules)

    def bound_objects(self) -> list[object]:
        """The objects whose methods are bound to rules."""
        return self._instance.objects()

    def _ready(self, snapshot: Snapshot, name: str) -> Plan:
        try:
            place = snapshot.program.places.get(name)
        except TypeError:  # not hashable, so no name
            place = None
        if place is None:
            raise UnknownTrigger(name, snapshot.program.places)
        cell = snapshot.rows[place[0]][place[1]]
        ready = cell.plan
        if ready is None or ready.mark is not snapshot.mark:
            # Two threads may both make the plan; they make the same one.
            ready = cell.plan = plan(snapshot, (name,), self._instance)
        return ready

    def _timekeeper(self, program: Program) -> Timekeeper | None:
        """What keeps the times of `program`; None if it has none, and none of before has. Raises UnsupportedTimes."""
        if not program.ruleset.is_timed and not self._chains:
            return self._times
        from sleec_runtime.timed.unenforced_constructs import has_times, name_limits

        name_limits(program.ruleset, self._chains, self._strict_times)
        if self._times is not None or not (self._chains or has_times(program.ruleset)):
            return self._times
        from sleec_runtime.timed.clocks import MonotonicClock
        from sleec_runtime.timed.scheduler import Timekeeper

        clock = self._clock
        if clock is None:
            clock = self._own_clock = MonotonicClock()
        return Timekeeper(lambda: (self._snapshot, self._instance), clock, self._chains, self._on_error)

    def _plan_anew(self, labels: Iterable[str]) -> None:
        by_label = self.ruleset.by_label
        triggers = dict.fromkeys(by_label[label].trigger for label in labels if label in by_label)
        self._snapshot = self._snapshot.without_plans(triggers)

    def _install(self, program: Program, instance: Instance, demand: Demand | None) -> None:
        if demand is not None:
            demand.check(program.whole, program.domain)
        before = self._snapshot
        were_missing = self._instance.missing(before.program.ruleset.rules)
        problems = [
            problem for label, problem in instance.missing(program.ruleset.rules).items() if label not in were_missing
        ]
        if problems:
            labels = [label for problem in problems for label in problem.rules]
            raise NotBound(
                "the rules stay as they are: " + listed([problem.message for problem in problems], "; "),
                labels,
                "bring the code with replace(…, bind=…, implement=…)",
            )
        known = {name: value for name, value in before.conditions.items() if name in program.vocabulary}
        after = Snapshot.first(program, known, before.number + 1)
        if self.activated_globally:
            instance.allow_calls(program.ruleset.rules)
        self._object(before, after, program.ruleset.rules)
        self._watch_bound(instance, program)
        times = self._timekeeper(program)
        # In one step, so that a signal handler finds all of before or all of after. A dispatch reads `_snapshot` before
        # `_times`, so that it never finds rules with times and nothing that keeps these.
        vars(self).update(_snapshot=after, _instance=instance, _demand=demand, _times=times)
        self._tell(before, after, program.ruleset.rules)

    def _watch_bound(self, instance: Instance, program: Program) -> None:
        if self._monitor is not None:
            self._monitor.watch(instance.objects(), program.whole.obligations)

    def _object(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        for objection in self._objections:
            objection(before, after, rules)

    def _tell(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        for listener in tuple(self._listeners):
            listener(before, after, rules)
