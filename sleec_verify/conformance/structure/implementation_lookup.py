"""Which functions of the target implement an obligation, as seen from one variant."""

from __future__ import annotations

from sleec_verify.conformance.structure.names import Names
from sleec_verify.conformance.structure.program import Function
from sleec_verify.conformance.structure.resolve import Resolver
from sleec_verify.conformance.structure.values import ClassOf, Environment, Object, Value


class ImplementationLookup:
    """The implementations that `variant` reaches, with the values `given` to its parameters."""

    def __init__(self, resolver: Resolver, names: Names, variant: Function, given: Environment) -> None:
        self._resolver = resolver
        self._names = names
        self._variant = variant
        self._given = given

    def obligation_of(self, function: Function, receiver: Value | None) -> str | None:
        """The obligation that a function of the target implements, if it is the robot's or marked."""
        names = self._names
        name = names.of(function)
        if name is None or names.mark(function) is not None or self.is_robots(receiver):
            return name
        return name if not self.robot_implements(name) else None

    def is_robots(self, receiver: Value | None) -> bool:
        robot = self._variant.owner
        if receiver is None:
            return robot is None
        if not isinstance(receiver, (Object, ClassOf)) or robot is None:
            return False
        return robot in self._resolver.order(receiver.class_)[0]

    def robot_implements(self, name: str) -> bool:
        """Whether the robot implements an obligation itself, or a function marked with it exists."""
        names = self._names
        if name in names.marked:
            return True
        receiver = self._given.get(self._self_name() or "")
        robot = receiver.class_ if isinstance(receiver, Object) else self._variant.owner
        if robot is None:
            return any(
                isinstance(one, Function)
                for method, obligations in names.by_method.items()
                if name in obligations
                for one in self._variant.scope.module.bindings.get(method, ())
            )
        return any(
            name in names.by_method.get(attribute, ())
            for above in self._resolver.order(robot)[0]
            for attribute in above.inner.bindings
        )

    def _self_name(self) -> str | None:
        parameters = self._variant.parameters
        return parameters[0].arg if parameters else None
