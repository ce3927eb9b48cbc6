"""The errors of transports and messages that a user can cause."""

from __future__ import annotations

from sleec_runtime.errors import SleecError, UnknownName


class TransportUnavailable(SleecError):
    """A transport that cannot start, or that is used after `close` or in a forked process."""


class UnknownMessageType(UnknownName):
    """A ROS message type without a definition."""

    kind = "message type"
    holder = "the type store"


class InvalidDefinition(SleecError):
    """A definition of a ROS message type that is not the text of a `.msg` file."""


class WrongFields(SleecError):
    """Fields that do not fit the type of their message."""


class MalformedMessage(SleecError):
    """An invalid message, which has no effect."""
