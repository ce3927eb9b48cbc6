"""The problems that nodes report, in addition to those of messages and rules."""

from __future__ import annotations

from sleec_runtime.errors import SleecError


class OutOfStep(SleecError):
    """A node does not have the present context of the Context Manager, so it does not decide by the rules."""


class NoManager(OutOfStep):
    """A node has not received the context from a Context Manager yet."""

    def __init__(self) -> None:
        super().__init__(
            "no Context Manager is known yet",
            "start one that this node can reach; over DDS, with the same ROS_DOMAIN_ID",
        )


class RulesDiffer(SleecError):
    """Two nodes have different rules or readings."""


class SecondManager(SleecError):
    """Two Context Managers are active at once."""


class OutOfRange(SleecError):
    """A value outside the range that the rules declare for its measure."""


class Unfit(SleecError):
    """A message that the mapping of a monitor does not fit."""
