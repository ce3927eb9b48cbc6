"""Mutants of the instance: triggers within triggers, one rule after the other, replaced rules, and threads."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from typing import Any

from sleec_runtime import Sleec
from sleec_runtime.model import Ruleset
from tests.support.mutants.robot import Instance, instance, mutant
from tests.support.robots import listing_2


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
