"""Mutants of the instance: of how changes are applied, what a trigger is decided in, and what runs."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from sleec_runtime import Sleec
from sleec_runtime.evaluation import Decision
from sleec_runtime.model import Ruleset
from sleec_runtime.obligations import recording
from tests.conformance.mutants.robot import DOMAIN, RULES, Instance, instance, mutant, read
from tests.runtime.robots import Log, listing_2


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
    """Where the rules conflict, one of the things is done before it is refused."""

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


def _each_rule_by_itself(sleec: Sleec) -> dict[str, Sleec]:
    """An instance a rule, with the same code."""
    parts = {}
    for rule in sleec.ruleset.rules:
        statements = tuple(s for s in sleec.ruleset.statements if s is rule or not hasattr(s, "label"))
        parts[rule.label] = Sleec(Ruleset(statements, sleec.ruleset.reading))
        listing_2(parts[rule.label])
    return parts


class RuleAfterRule(Instance):
    """Runs the rules of a trigger one after the other, each by an instance of its own."""

    def occur(self, names: tuple[str, ...]) -> Any:
        self.due(*names)
        parts = self.__dict__.setdefault("parts", None) or _each_rule_by_itself(self)
        self.__dict__["parts"] = parts
        for rule in self.ruleset.rules:
            if rule.trigger in names:
                vocabulary = parts[rule.label].vocabulary
                known = self.conditions
                parts[rule.label].update({name: known.get(name) for name in vocabulary})
                self.run_rule(parts[rule.label], rule.trigger)

    def run_rule(self, part: Sleec, trigger: str) -> None:
        part.trigger(trigger)


@mutant
def exception_stops_other_rules() -> Sleec:
    """If a variant raises, the rules after it are not served."""
    return instance(RuleAfterRule)


@mutant
def decided_one_after_the_other() -> Sleec:
    """Each rule of a trigger is decided when its turn comes, maybe in another context than the one before."""

    class Mutant(RuleAfterRule):
        def occur(self, names: tuple[str, ...]) -> Any:
            self.__dict__["failures"] = []
            super().occur(names)
            for failure in self.__dict__["failures"]:
                raise failure

        def run_rule(self, part: Sleec, trigger: str) -> None:
            try:
                super().run_rule(part, trigger)
            except Exception as failure:  # noqa: BLE001
                self.__dict__["failures"].append(failure)

    return instance(Mutant)


@mutant
def inner_trigger_in_the_outer_context() -> Sleec:
    """A trigger within a trigger is decided in the context of the outer one."""

    class Mutant(Instance):
        depth = 0

        def update(self, changes: Mapping[str, object]) -> None:
            if self.depth:
                self.__dict__.setdefault("later", {}).update(changes)
            else:
                super().update(changes)

        def occur(self, names: tuple[str, ...]) -> Any:
            self.depth += 1
            try:
                return super().occur(names)
            finally:
                self.depth -= 1
                if not self.depth:
                    super().update(self.__dict__.pop("later", {}))

    return instance(Mutant)


@mutant
def inner_trigger_unheard() -> Sleec:
    """While one trigger is served, others are lost."""

    class Mutant(Instance):
        busy = False

        def occur(self, names: tuple[str, ...]) -> Any:
            if self.busy:
                return None
            self.busy = True
            try:
                return super().occur(names)
            finally:
                self.busy = False

    return instance(Mutant)


@mutant
def busy_for_ever_after_an_exception() -> Sleec:
    """A lock that is not given back when a variant raises: the next trigger is taken for an inner one."""

    class Mutant(Instance):
        depth = 0

        def occur(self, names: tuple[str, ...]) -> Any:
            if self.depth > 1:
                return None
            self.depth += 1
            done = super().occur(names)
            self.depth -= 1
            return done

    return instance(Mutant)


@mutant
def stale_snapshot_after_replace() -> Sleec:
    """Other rules come into force with the next change of context."""

    class Mutant(Instance):
        def replace(self, ruleset: Ruleset, **code: Any) -> None:
            self.__dict__["waiting"] = ruleset

        def update(self, changes: Mapping[str, object]) -> None:
            waiting = self.__dict__.pop("waiting", None)
            if waiting is not None:
                super().replace(waiting)
            super().update(changes)

    return instance(Mutant)


@mutant
def context_lost_at_replace() -> Sleec:
    """With other rules in force, the robot has forgotten the situation."""

    class Mutant(Instance):
        def replace(self, ruleset: Ruleset, **code: Any) -> None:
            super().replace(ruleset)
            super().update(dict.fromkeys(self.conditions))

    return instance(Mutant)


@mutant
def context_of_its_own_in_each_thread() -> Sleec:
    """What one thread reports, no other knows."""

    class Mutant(Instance):
        def update(self, changes: Mapping[str, object]) -> None:
            self.mine.update(changes)

        @property
        def mine(self) -> dict[str, object]:
            local = self.__dict__.setdefault("local", threading.local())
            known: dict[str, object] = local.__dict__.setdefault("known", {})
            return known

        def occur(self, names: tuple[str, ...]) -> Any:
            with self.__dict__.setdefault("lock", threading.RLock()):
                Sleec.update(self, {**dict.fromkeys(self.conditions), **self.mine})
                return super().occur(names)

    return instance(Mutant)


@mutant
def context_leaks_between_threads() -> Sleec:
    """A dispatch keeps what it was decided in on the instance, where another thread's dispatch overwrites it."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            self.__dict__["current"] = dict(self.conditions)
            for name in sorted({rule.label for rule in self.ruleset.rules if rule.trigger in names}):
                time.sleep(0)
                self._run(name)

        def _run(self, label: str) -> None:
            rule = self.ruleset.by_label[label]
            part = Sleec(Ruleset((*self.ruleset.measures.values(), rule), self.ruleset.reading))
            listing_2(part)
            known = self.__dict__["current"]
            part.update({name: known.get(name) for name in part.vocabulary})
            part.trigger(rule.trigger)

    return instance(Mutant)


@contextmanager
def _unseen() -> Iterator[None]:
    with recording():
        yield


@mutant
def work_given_to_another_thread() -> Sleec:
    """What is due is done some time later, by another thread, when nobody looks."""

    class Mutant(Instance):
        def occur(self, names: tuple[str, ...]) -> Any:
            self.due(*names)
            thread = threading.Thread(target=super().occur, args=(names,))
            thread.start()
            thread.join()

    return instance(Mutant)


@mutant
def nothing_bound() -> Sleec:
    """An instance without any code."""
    return Sleec(read(RULES), domain=DOMAIN)
