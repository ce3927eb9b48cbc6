"""Mutants of the robot's code: each overrides a variant or two of the correct class."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code="no-redef, misc"
from __future__ import annotations

from typing import Any

import contextpy3 as cop

from sleec_runtime import Sleec
from tests.support.mutants.robot import DOMAIN, RULES, coded, mutant, read
from tests.support.robots import Log


def overriding(label: str, number: int, *does: str) -> Sleec:
    """The robot with one variant that does something else."""

    def mutate(sleec: Sleec, robot: type[Log]) -> type[Log]:
        decorate = cop.around(sleec.layers[f"{label}.hc{number}"]) if number else cop.base

        class Mutant(robot):  # type: ignore[valid-type]
            pass

        def variant(self: Log) -> None:
            for name in does:
                self.do(name)

        variant.__name__ = label
        setattr(Mutant, label, decorate(variant))
        return Mutant

    return coded(mutate)


@mutant
def wrong_layer() -> Sleec:
    """The code of the first hedge is bound to the layer of the second too."""
    return overriding("curtains", 2, "RefuseRequest", "ExplainWhy")


@mutant
def swapped_hedges() -> Sleec:
    """Each hedge has the code of the other."""

    def mutate(sleec: Sleec, robot: Any) -> type[Log]:
        class Mutant(robot):
            @cop.around(sleec.layers["curtains.hc2"])
            def curtains(self) -> None:
                self.do("RefuseRequest")
                self.do("ExplainWhy")

            @cop.around(sleec.layers["curtains.hc1"])
            def curtains(self) -> None:
                self.do("WarnUser")
                self.do("OpenCurtains")

        return Mutant

    return coded(mutate)


@mutant
def missing_obligation() -> Sleec:
    """It refuses and does not say why."""
    return overriding("curtains", 1, "RefuseRequest")


@mutant
def extra_obligation() -> Sleec:
    """It opens the curtains and greets, which nobody asked for."""
    return overriding("curtains", 0, "OpenCurtains", "Greet")


@mutant
def wrong_order() -> Sleec:
    """It opens the curtains, and warns afterwards."""
    return overriding("curtains", 2, "OpenCurtains", "WarnUser")


@mutant
def duplicate_execution() -> Sleec:
    """It opens the curtains twice."""
    return overriding("curtains", 0, "OpenCurtains", "OpenCurtains")


@mutant
def prohibited_done() -> Sleec:
    """It speaks where it must not."""
    return overriding("record", 1, "WriteLog", "Speak")


@mutant
def does_nothing() -> Sleec:
    """A variant that was forgotten to be filled in."""
    return overriding("curtains", 2)


@mutant
def proceeds_to_the_base() -> Sleec:
    """The variant of a hedge also runs the default."""

    def mutate(sleec: Sleec, robot: Any) -> type[Log]:
        class Mutant(robot):
            @cop.around(sleec.layers["curtains.hc1"])
            def curtains(self) -> None:
                self.do("RefuseRequest")
                self.do("ExplainWhy")
                cop.proceed()

        return Mutant

    return coded(mutate)


@mutant
def looks_for_itself() -> Sleec:
    """The base looks at a condition again, and has it the wrong way round."""

    def mutate(sleec: Sleec, robot: Any) -> type[Log]:
        class Mutant(robot):
            @cop.base
            def curtains(self) -> None:
                self.do("ExplainWhy" if sleec.conditions.get("Distressed") else "OpenCurtains")

        return Mutant

    return coded(mutate)


@mutant
def only_the_first_time() -> Sleec:
    """What was done once is not done again."""

    def mutate(sleec: Sleec, robot: Any) -> type[Log]:
        class Mutant(robot):
            done = False

            @cop.base
            def curtains(self) -> None:
                if not self.done:
                    self.do("OpenCurtains")
                self.done = True

        return Mutant

    return coded(mutate)


@mutant
def swallowed_exception() -> Sleec:
    """A variant hides that an obligation failed."""

    def mutate(sleec: Sleec, robot: Any) -> type[Log]:
        class Mutant(robot):
            @cop.base
            def curtains(self) -> None:
                try:
                    self.do("OpenCurtains")
                except Exception:  # noqa: BLE001
                    return

        return Mutant

    return coded(mutate)


def _only(*numbers: int) -> Sleec:
    """A robot that has the variants of the curtains with these numbers, and no others."""
    sleec = Sleec(read(RULES), domain=DOMAIN)
    robot = Log()
    sleec.implement({name: lambda name=name: robot.do(name) for name in sleec.ruleset.obligations})
    responses = [[o.name for o in clause.obligations] for clause in sleec.ruleset.by_label["curtains"].clauses()]
    method: Any = None
    namespace: dict[str, Any] = {"cop": cop, "sleec": sleec, "robot": robot, "responses": responses}
    lines = ["class Robot:"]
    for place, number in enumerate(numbers):
        layer = f'@cop.around(sleec.layers["curtains.hc{number}"])' if number else "@cop.base"
        lines += ["    @sleec.rule('curtains')"] if place == len(numbers) - 1 else []
        lines += [f"    {layer}", f"    def curtains(self): [robot.do(name) for name in responses[{number}]]"]
    exec("\n".join(lines), namespace)
    method = namespace["Robot"]()
    sleec.bind(method)
    return sleec


@mutant
def base_missing() -> Sleec:
    """A method with variants for the hedges and none for the default."""
    return _only(1, 2)


@mutant
def hedge_missing() -> Sleec:
    """A method without the variant of one hedge."""
    return _only(0, 1)
