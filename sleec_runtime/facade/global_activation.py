"""Global activation, the mode of the paper (Section 4): each change of context activates layers globally.

It is for code that calls layered methods itself, such as the ROS callbacks of Listing 2 in the paper. It cannot be made
safe: ContextPy3 changes one layer at a time, so that a call between two changes sees only the first. Each call walks
all active layers (about 0.5 µs each).
"""

from __future__ import annotations

from functools import partial
from types import TracebackType

import contextpy3

from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.dispatch.decisions import due_in
from sleec_runtime.dispatch.layers import RuleLayer
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import SleecError
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.facade.host import Host
from sleec_runtime.model import Rule, require_untimed

# ContextPy3 has one tuple of global layers for the process, and reads and writes it without a lock.
_GLOBAL_LAYERS = CriticalSection()


class GlobalActivation:
    """Keeps the layers of the active clauses globally active: the layer manager LM of the paper, for each rule as if
    its trigger occurred. Use `trigger` where you can, and this only where other code makes the call.

    It does not check each call for conflicts, distinguish a false guard from the ε of a rule, or change several layers
    atomically. It activates the new layer of a rule before it deactivates the old one, because in ContextPy3 the last
    activated layer decides; in the other order, the base could run in between.
    """

    def __init__(self, sleec: Host) -> None:
        self._sleec = sleec
        self._active: dict[str, RuleLayer] = {}
        self._end = self._not_started

    def start(self) -> GlobalActivation:
        """Activates the layers of the current context, and renews them on each change. O(rules).

        If this raises an error, nothing is activated. While global activation is on, changes of context and bindings
        with these problems are rejected.

        Raises:
            UnsupportedTimes: the rules have times.
            ConflictInContext, UndeterminedDecision: a trigger would raise it in this context.
            Unbindable: a plain call cannot dispatch a bound method.
            SleecError: global activation is already on, or other code has activated one of the layers.
        """
        self._sleec.hold(lambda snapshot: _GLOBAL_LAYERS.run(partial(self._start, snapshot)))
        return self

    def _start(self, snapshot: Snapshot) -> None:
        _refuse_times(snapshot)
        if self._sleec.activated_globally:
            raise SleecError("global activation is already on", "stop() it first")
        self._sleec.allow_calls()
        for trigger in snapshot.index.number_of:
            due_in(snapshot, (trigger,))
        layers = self._due_layers(snapshot, snapshot.index.ruleset.rules)
        self._refuse_active(layers)
        self._renew(layers)
        self._end = self._sleec.listen(self._changed, self._refuse)

    def stop(self) -> None:
        """Deactivates the layers that this object activated."""
        self._sleec.hold(lambda snapshot: _GLOBAL_LAYERS.run(self._stop))

    def _stop(self) -> None:
        self._end()
        self._end = self._not_started
        self._renew(dict.fromkeys(self._active))

    def __enter__(self) -> GlobalActivation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def _refuse(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        _GLOBAL_LAYERS.refuse_reentry()
        _refuse_times(after)
        # A NEVER may now contradict rules that do not mention the changed names.
        everything = before.mark is not after.mark
        for trigger in after.index.number_of if everything else dict.fromkeys(rule.trigger for rule in rules):
            due_in(after, (trigger,))
        self._refuse_active(self._due_layers(after, rules))

    def _refuse_active(self, layers: dict[str, RuleLayer | None]) -> None:
        for label, layer in layers.items():
            if layer is not None and layer is not self._active.get(label) and layer in contextpy3._BASELAYERS:
                raise SleecError(f"layer `{layer.name}` is already globally active", "deactivate it first")

    def _changed(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        layers = self._due_layers(after, rules)
        if before.index is not after.index:
            layers = {**dict.fromkeys(self._active), **layers}
        _GLOBAL_LAYERS.run(partial(self._renew, layers))

    def _due_layers(self, snapshot: Snapshot, rules: tuple[Rule, ...]) -> dict[str, RuleLayer | None]:
        outcomes = {rule.label: snapshot.outcome(rule) for rule in rules}
        return {
            label: self._sleec.layers.of(outcome.layer) if isinstance(outcome, Decision) else None
            for label, outcome in outcomes.items()
        }

    def _renew(self, layers: dict[str, RuleLayer | None]) -> None:
        for label, layer in layers.items():
            old = self._active.get(label)
            if layer is old:
                continue
            if layer is not None:
                contextpy3.global_activate_layer(layer)
                self._active[label] = layer
            if old is not None:
                # Unless other code deactivated it.
                if old in contextpy3._BASELAYERS:
                    contextpy3.global_deactivate_layer(old)
                if layer is None:
                    del self._active[label]

    @staticmethod
    def _not_started() -> None:
        raise SleecError("global activation is not on", "start() it first")


def _refuse_times(snapshot: Snapshot) -> None:
    require_untimed(snapshot.index.ruleset, "global activation")
