"""The facade of the runtime: a ruleset in force, with its context and code."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from sleec_runtime.concurrency.critical_section import exclusive
from sleec_runtime.dispatch.decisions import trigger_outcomes
from sleec_runtime.dispatch.execution import run
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.required_code import missing
from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Conditions, Snapshot
from sleec_runtime.errors import NotBound, UnknownObligation
from sleec_runtime.evaluation.due import Due, broken_assumptions
from sleec_runtime.facade import arguments
from sleec_runtime.facade.dispatcher import Dispatcher
from sleec_runtime.facade.done import Done
from sleec_runtime.facade.global_activation import GlobalActivation
from sleec_runtime.facade.host import Host
from sleec_runtime.model import Assume, Measure, Reading, Ruleset
from sleec_runtime.support.messages import listed

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType

    from sleec_runtime.certificate.requirement import CertificateRequirement
    from sleec_runtime.timed.clock import Clock, Time
    from sleec_runtime.timed.failures import Failure
    from sleec_runtime.timed.pending import Pending

F = TypeVar("F")


class Sleec(Host):
    """A CO-SLEEC instance (paper, Section 3.2) with its current context.

    All methods are thread-safe. A dispatch reads one reference and never waits; changes hold a lock. `domain` leaves
    out the rules of other domains. `reading` overrides the reading of the ruleset. In `strict` mode, a decision that
    depends on unreported conditions raises UndeterminedDecision; otherwise they are false (Definition 1).

    For rules with time (docs/runtime.md): `clock` measures their windows; the default is the clock of the computer,
    with a thread while something is pending. With `chains`, a response that is done is an event, which triggers the
    rules of that name. `on_error` gets each `Failure` of what the clock starts; without it, failures are logged.
    Constructs that the runtime does not enforce cause a NotEnforced warning, or UnsupportedTimes with `strict_times`.

    `certificate` is the folder of a certificate that must prove the rules free of conflict as they are used. `replace`
    then needs a certificate too. With `key`, the file of a public key, certificates must be signed with it. With
    `require_proved` or `require_tied`, they must be made with these options (docs/certificates.md).

    Raises UnknownDomain, WrongType, CertificateRefused and UnsupportedTimes.
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
        index = RuleIndex(whole, domain, strict)
        self._demand = arguments.demand(certificate, chains, key, **required)
        if self._demand is not None:
            self._demand.check(whole, domain)
        self._reading = reading
        self._strict = strict
        self._chains = chains
        self._strict_times = strict_times
        arguments.check_clock(clock)
        self._clock = clock
        self._on_error = on_error
        super().__init__(Snapshot.first(index, {}), Instance(whole))
        self._dispatcher = self._dispatcher_for(index, Dispatcher(self._state))

    # State --------------------------------------------------------------------------------------

    @property
    def ruleset(self) -> Ruleset:
        """The rules in force: those of the domain, with their reading."""
        return self._snapshot.index.ruleset

    @property
    def domain(self) -> str | None:
        """The domain of the rules in force; None for all domains."""
        return self._snapshot.index.domain

    @property
    def clock(self) -> Clock | None:
        """The clock that measures windows; None for the clock of the computer."""
        return self._clock

    @property
    def chains(self) -> bool:
        """Whether a response triggers the rules of its name."""
        return self._chains

    @property
    def conditions(self) -> Conditions:
        """The reported conditions and measures, as an immutable mapping."""
        return self._snapshot.conditions

    @property
    def vocabulary(self) -> Mapping[str, Measure | None]:
        """The names that `update` accepts: conditions, with None, and measures, with their declarations."""
        return self._snapshot.index.vocabulary

    # Code for the rules ---------------------------------------------------------------------------------

    def rule(self, label: str) -> Callable[[F], F]:
        """Marks a method as the one of rule `label`, MM(R); place it above ``@cop.base``. Raises UnknownLabel."""
        return self._instance.mark(label)

    @exclusive
    def bind(self, *targets: object) -> None:
        """Binds the marked methods of objects, classes, modules or functions to their rules: all of them, or none.

        The variants of a method are read now, so define them all before.

        Raises:
            Unbindable: a target has no marked method, two variants are on one layer, or a variant is on a layer of
                another rule. Under global activation, also if a plain call cannot dispatch the method.
            AlreadyBound: a rule has a second method.
        """
        with self._instance.kept_on_failure():
            labels = self._instance.bind(targets, self.ruleset.rules if self.activated_globally else ())
            self._watch_bound(self._instance, self._snapshot.index)
            self._plan_anew(labels)

    @exclusive
    def unbind(self, *labels: str) -> None:
        """Removes the methods of rules. Dispatches that have begun still use them. Raises UnknownLabel."""
        with self._instance.kept_on_failure():
            self._instance.unbind(labels)
            self._plan_anew(labels)

    @exclusive
    def implement(self, target: object) -> None:
        """Sets the callables of obligations. Rules without a method call them in the order of the clause.

        `target` maps names to callables, or is an object or module whose callables are marked with
        ``@sleec_runtime.obligation("OpenCurtains")`` or named in snake case. Each gets the arguments of the trigger.
        Raises UnknownObligation, and Unbindable for a value that is not callable or a target that implements nothing.
        """
        with self._instance.kept_on_failure():
            self._instance.implement(target, self._snapshot.index.whole.obligations)
            self._plan_anew(rule.label for rule in self.ruleset.rules)

    def missing(self) -> Mapping[str, NotBound]:
        """The rules whose code is missing in some context, with the reason. O(clauses)."""
        return missing(self.ruleset.rules, self._instance)

    # Context --------------------------------------------------------------------------------------------

    @exclusive
    def update(self, changes: Mapping[str, object]) -> None:
        """Changes the context atomically: no dispatch sees a part of the change.

        None removes a value: it is no longer known. O(changes + size of the rules that mention them). Raises
        UnknownCondition and WrongType; under global activation also ConflictInContext and UndeterminedDecision. Nothing
        changes then.
        """
        before = self._snapshot
        after, rules = before.changed(changes)
        if after is not before:
            self._object(before, after, rules)
            self._snapshot = after
            self._tell(before, after, rules)

    def broken_assumptions(self, *triggers: str) -> tuple[Assume, ...]:
        """The assumptions (ASSUME) that the context breaks if `triggers` occur.

        The proofs about the rules hold only in contexts that break none. A broken assumption suggests a faulty sensor.
        Rules decide in such a context as in any other. Raises UnknownTrigger.
        """
        snapshot = self._snapshot
        for trigger in triggers:
            trigger_outcomes(snapshot, trigger)
        return broken_assumptions(snapshot.index.ruleset, snapshot.context(triggers))

    # Triggers -------------------------------------------------------------------------------------------

    def trigger(self, name: str, /, *args: Any, **kwargs: Any) -> Done:
        """A trigger occurs: decides all its rules in one context, and runs their variants with these arguments.

        All errors are raised before anything runs: UnknownTrigger, NotBound, UndeterminedDecision
        (in strict mode), ConflictInContext, WrongArguments, NeedsAwait. If a variant raises, those of other rules still
        run; then its error is raised (VariantsFailed for several). O(rules of the trigger) the first time in a context,
        then O(rules that apply), however many other rules there are.
        """
        snapshot = self._snapshot  # before the dispatcher: see `_install`
        # The common case without more calls, because each call takes time.
        plan = snapshot.ready_plans.get(name) if type(name) is str else None
        if plan is not None and self._monitor is None and not kwargs and len(args) in plan.ready_for:
            return Done(plan, snapshot, run(plan, args, kwargs))
        return self._dispatcher.trigger(snapshot, (name,), args, kwargs, self._monitor)

    def anticipate(self, name: str, /, *args: Any) -> None:
        """Prepares `trigger` with such arguments, so that it takes less time in the present context. Runs nothing.
        Raises as `trigger` before anything runs."""
        snapshot = self._snapshot  # before the dispatcher, as in `trigger`
        self._dispatcher.anticipate(snapshot, name, args)

    def trigger_all(self, names: Iterable[str], /, *args: Any, **kwargs: Any) -> Done:
        """Several triggers occur at once, in one context. Their rules run in rule order. Otherwise as `trigger`."""
        snapshot = self._snapshot
        return self._dispatcher.trigger(snapshot, arguments.triggers(names), args, kwargs, self._monitor)

    async def trigger_async(self, name: str, /, *args: Any, **kwargs: Any) -> Done:
        """`trigger` for variants that may be coroutine functions, which it awaits one after the other. The context is
        the one when the call is first awaited."""
        snapshot = self._snapshot
        return await self._dispatcher.trigger_async(snapshot, (name,), args, kwargs, self._monitor)

    async def trigger_all_async(self, names: Iterable[str], /, *args: Any, **kwargs: Any) -> Done:
        """`trigger_all` for variants that may be coroutine functions."""
        snapshot = self._snapshot
        return await self._dispatcher.trigger_async(snapshot, arguments.triggers(names), args, kwargs, self._monitor)

    def due(self, *names: str) -> Due:
        """What would be due if these triggers occurred now. It runs nothing, and needs no code. Raises as `trigger`,
        except for code."""
        snapshot = self._snapshot
        return self._dispatcher.due(snapshot, names)

    # Times ----------------------------------------------------------------------------------------------

    def completed(self, obligation: str) -> tuple[Pending, ...]:
        """An obligation that takes time is done now. Returns the pending obligations that this fulfils.

        With `chains`, it also triggers the rules of that name, with the arguments of the trigger that asked for it.
        Raises UnknownObligation; Prohibited if a rule forbids it now, although it is done; and as `trigger`.
        """
        if not isinstance(obligation, str):
            raise UnknownObligation(obligation, self._snapshot.index.whole.obligations)
        return self._dispatcher.completed(obligation)

    def pending(self) -> tuple[Pending, ...]:
        """The obligations that are still to be done, and the prohibitions that are still in force, by the ends of their
        windows. It includes those of rules that have been replaced."""
        return self._dispatcher.pending()

    @property
    def failures(self) -> tuple[Failure, ...]:
        """The failures of what the clock started, and the missed deadlines: the last thousand, in order."""
        return self._dispatcher.failures()

    def pending_snapshot(self, now: Time | None = None) -> dict[str, Any]:
        """What is pending, as plain data for `json.dump`, which another process can `restore` after this one ends.

        `now` is the time in seconds since 1970, by default that of the computer. The data contain the arguments of
        triggers whose code may still run. O(pending). Raises WrongType for an argument that is not plain data, and
        SnapshotRefused for rules that were not read from a text.
        """
        return self._dispatcher.pending_snapshot(arguments.world_time(now))

    def restore(self, snapshot: Mapping[str, Any], now: Time | None = None) -> tuple[Pending, ...]:
        """Continues with what was pending when another process took `snapshot`. Returns what is pending now.

        Bind the code and report the context first, and trigger nothing before. Code that was to start since then starts
        now. An obligation that was under way stays so. A deadline that has passed since then is missed now: the
        ``OTHERWISE`` starts, or `failures` gets a DeadlineMissed. `now` is as in `pending_snapshot`.

        Raises SnapshotRefused for a snapshot that is malformed, of other rules or another reading or domain, from a
        later time, or already restored; NotBound and WrongArguments if the code does not fit. Nothing changes then.
        """
        return self._dispatcher.restore(snapshot, arguments.world_time(now))

    def tick(self) -> None:
        """Handles all timer events up to now, for a clock without alarms. Errors are in `failures` and not raised,
        except a KeyboardInterrupt in the main thread."""
        self._dispatcher.tick()

    def close(self) -> None:
        """Stops all timer events, and the thread of the default clock; waits for its running code, up to the limit of
        the clock. What is pending stays so. A trigger that would add to it raises SleecError. ``with sleec:`` closes at
        its end."""
        self._dispatcher.close()

    def __enter__(self) -> Sleec:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # Other rules, other modes ---------------------------------------------------------------------------

    @exclusive
    def prepare(self, ruleset: Ruleset) -> None:
        """Adds the labels and layers of `ruleset`, so that methods can be marked for it before `replace`."""
        self._instance.admit(arguments.ruleset(ruleset, self._reading))

    def replace(
        self,
        ruleset: Ruleset,
        *,
        bind: Iterable[object] = (),
        implement: object = None,
        certificate: str | Path | None = None,
    ) -> None:
        """Puts other rules in force, atomically. Dispatches that have begun finish under the old rules.

        Layers with the same name stay the same objects, methods stay bound by label, and reported values stay known.
        `bind` and `implement` add the code of new rules. An instance with a certificate needs `certificate` for them,
        signed with the same key if it has one.

        Raises NotBound if a rule loses its code, WrongType if a reported value does not fit the new declarations,
        CertificateRefused, and as `bind` and `implement`. Nothing changes then.
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
        self._install(RuleIndex(whole, self.domain, self._strict), instance, demand)

    @exclusive
    def enter_domain(self, domain: str | None) -> None:
        """Puts the rules of another domain in force, as `replace` does. Raises UnknownDomain, and CertificateRefused if
        the certificate does not cover the domain."""
        index = RuleIndex(self._snapshot.index.whole, domain, self._strict)
        self._install(index, self._instance, self._demand)

    def activate_globally(self) -> GlobalActivation:
        """Starts the mode of the paper (Section 4): the layers of the active clauses are globally active, so that
        methods can be called without a trigger. `GlobalActivation` documents its cost and its limits. Raises
        UnsupportedTimes for rules with time, and as `GlobalActivation.start`."""
        return GlobalActivation(self).start()

    def _dispatcher_for(self, index: RuleIndex, current: Dispatcher) -> Dispatcher:
        """The dispatcher for `index`: the `current` one, or a timed one from the first rules with time on. Raises
        UnsupportedTimes."""
        if not index.ruleset.is_timed and not self._chains:
            return current
        from sleec_runtime.timed.unenforced_constructs import has_times, name_limits

        name_limits(index.ruleset, self._chains, self._strict_times)
        if type(current) is not Dispatcher or not (self._chains or has_times(index.ruleset)):
            return current
        from sleec_runtime.facade.timed_dispatcher import TimedDispatcher

        return TimedDispatcher(self._state, self._clock, self._chains, self._on_error)

    def _plan_anew(self, labels: Iterable[str]) -> None:
        by_label = self.ruleset.by_label
        triggers = dict.fromkeys(by_label[label].trigger for label in labels if label in by_label)
        self._snapshot = self._snapshot.without_plans(triggers)

    def _refuse_loss(self, index: RuleIndex, instance: Instance) -> None:
        were_missing = missing(self.ruleset.rules, self._instance)
        problems = {rule: it for rule, it in missing(index.ruleset.rules, instance).items() if rule not in were_missing}
        if problems:
            raise NotBound(
                "the rules are not replaced, because code is missing: "
                + listed([problem.message for problem in problems.values()], "; "),
                [label for problem in problems.values() for label in problem.rules],
                "add the code with replace(…, bind=…, implement=…)",
            )

    def _install(self, index: RuleIndex, instance: Instance, demand: CertificateRequirement | None) -> None:
        if demand is not None:
            demand.check(index.whole, index.domain)
        before = self._snapshot
        if not instance.is_partial:
            self._refuse_loss(index, instance)
        known = {name: value for name, value in before.conditions.items() if name in index.vocabulary}
        after = Snapshot.first(index, known, before.number + 1)
        if self.activated_globally:
            instance.allow_calls(index.ruleset.rules)
        self._object(before, after, index.ruleset.rules)
        self._watch_bound(instance, index)
        dispatcher = self._dispatcher_for(index, self._dispatcher)
        # In one step, so that a signal handler sees all of it or nothing. A dispatch reads `_snapshot` before
        # `_dispatcher`, so that a dispatcher without a clock never gets rules with time.
        vars(self).update(_snapshot=after, _instance=instance, _demand=demand, _dispatcher=dispatcher)
        self._tell(before, after, index.ruleset.rules)
