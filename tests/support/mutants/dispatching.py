"""Mutants of the instance: of how changes are applied, and what a trigger is decided in."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

from sleec_runtime import Sleec
from sleec_runtime.evaluation.hedge_chain import Decision
from tests.support.mutants.robot import DOMAIN, RULES, Instance, instance, mutant, read
from tests.support.robots import Log


@mutant
def half_applied_context() -> Sleec:
    """A change is applied one condition after the other, while triggers occur."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            for name, value in changes.items():
                super().update({name: value})

    return instance(Mutant)


@mutant
def half_applied_context_with_a_copy() -> Sleec:
    """The same, of a copy: only another thread can see it."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            for name, value in dict(changes).items():
                super().update({name: value})
                time.sleep(0)

    return instance(Mutant)


@mutant
def half_refused_change() -> Sleec:
    """A change that cannot be is refused when half of it is applied."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            whole = dict(changes)
            try:
                super().update(whole)
            except Exception:
                for name, value in whole.items():
                    super().update({name: value})
                raise

    return instance(Mutant)


@mutant
def wrong_type_taken() -> Sleec:
    """A value that cannot be is passed over in silence."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            try:
                super().update(dict(changes))
            except Exception:  # noqa: BLE001
                return

    return instance(Mutant)


@mutant
def stale_layer() -> Sleec:
    """What was decided for a trigger first is decided for ever."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            first = self.__dict__.setdefault("first", {}).setdefault(names, dict(self.conditions))
            now = dict(self.conditions)
            Sleec.update(self, {**dict.fromkeys(now), **first})
            try:
                return super().occur(names)
            finally:
                Sleec.update(self, {**dict.fromkeys(first), **now})

    return instance(Mutant)


@mutant
def late_by_one_change() -> Sleec:
    """Layers are renewed one change too late."""

    class Mutant(Instance):
        waiting: Mapping[str, object] = {}

        def update(self, changes: Mapping[str, object]) -> None:
            super().update(self.waiting)
            self.waiting = dict(changes)

    return instance(Mutant)


@mutant
def never_forgets() -> Sleec:
    """What is no longer known counts as it was."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            super().update({name: value for name, value in changes.items() if value is not None})

    return instance(Mutant)


@mutant
def forgets_what_is_not_mentioned() -> Sleec:
    """A change is taken for the whole context."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            super().update({**dict.fromkeys(self.conditions), **changes})

    return instance(Mutant)


@mutant
def rounded_measure() -> Sleec:
    """Measures are rounded, so that 17.9 years are 18."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            super().update({n: v if isinstance(v, (bool, str, type(None))) else round(v) for n, v in changes.items()})  # type: ignore[call-overload]

    return instance(Mutant)


@mutant
def unreported_counts_as_true() -> Sleec:
    """A condition that nobody reported is taken to hold."""
    sleec = instance()
    sleec.update({"Undressed": True})
    return sleec


@mutant
def shared_epsilon() -> Sleec:
    """One ε for all rules, as the paper has it to the letter: where one rule yields it, all run their base too."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            due = self.due(*names)
            done = super().occur(names)
            if any(decision.clause == 0 for decision in due.decisions):
                for decision in due.decisions:
                    if decision.clause:
                        _run_base(decision)
            return done

    return instance(Mutant)


def _run_base(decision: Decision) -> None:
    for literal in decision.rule.default.obligations:
        Log().do(literal.name)


@mutant
def first_trigger_only() -> Sleec:
    """Of triggers that occur together, one is heard."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            return super().occur(names[:1])

    return instance(Mutant)


@mutant
def triggers_one_after_the_other() -> Sleec:
    """Triggers that occur together are served each for itself, so that nobody sees that they conflict."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            for name in names:
                super().occur((name,))

    return instance(Mutant)


@mutant
def again_only_after_a_change() -> Sleec:
    """A trigger that occurs twice in one context is heard once."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            seen, self.__dict__["seen"] = self.__dict__.get("seen"), (names, dict(self.conditions))
            return None if seen == self.__dict__["seen"] else super().occur(names)

    return instance(Mutant)


@mutant
def conflict_half_executed() -> Sleec:
    """Where the rules contradict each other, one of the things is done before it is refused."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            try:
                return super().occur(names)
            except Exception as error:
                if hasattr(error, "conflict"):
                    Log().do(error.conflict.literals[0].name)
                raise

    return instance(Mutant)


@mutant
def exception_swallowed_by_the_instance() -> Sleec:
    """What a variant raises is lost."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            self.due(*names)
            try:
                return super().occur(names)
            except Exception:  # noqa: BLE001
                return None

    return instance(Mutant)


@mutant
def nothing_bound() -> Sleec:
    """An instance without any code."""
    return Sleec(read(RULES), domain=DOMAIN)
