"""The definitions of ROS message types, from the type store of rosbags and from the user."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sleec_runtime.ros.dds.message_types import PRIMITIVES, STANDARD, FieldType, Items, Message, String
from sleec_runtime.ros.transport_errors import InvalidDefinition, TransportUnavailable, UnknownMessageType

LONGEST_ARRAY = 1 << 20
"""The longest array of a message type. A message with a longer one exceeds any limit on messages."""


class TypeStore:
    """The message types of a ROS distribution, and further ones.

    `definitions` has the text of a `.msg` file for each further type, such as
    `{"my_msgs/msg/Grip": "float64 force"}`.
    """

    def __init__(self, distribution: str, definitions: Mapping[str, str]) -> None:
        self._distribution = distribution
        self._definitions = definitions
        self._messages = dict(STANDARD)
        self._store: Any = None

    def message(self, name: str) -> Message:
        """The message type `name`. Raises UnknownMessageType or InvalidDefinition."""
        known = self._messages.get(name)
        if known is None:
            definitions = self._rosbags().fielddefs
            if name not in definitions:
                raise UnknownMessageType(name, definitions, self._hint(name, definitions))
            _, fields = definitions[name]
            try:
                known = Message(name, tuple((field, self._field_type(kind)) for field, kind in fields))
            except RecursionError:
                raise InvalidDefinition(f"the message type {name!r} contains itself") from None
            self._messages[name] = known
        return known

    def _field_type(self, description: Any) -> FieldType:
        from rosbags.interfaces import Nodetype

        node, value = description
        if node == Nodetype.NAME:
            return self.message(value)
        if node != Nodetype.BASE:
            of, length = value
            if length > LONGEST_ARRAY:
                raise InvalidDefinition(f"an array of {length:,} values is too long", f"use at most {LONGEST_ARRAY:,}")
            return Items(self._field_type(of), length, fixed=node == Nodetype.ARRAY)
        name, bound = value
        return String(bound) if name == "string" else PRIMITIVES[name]

    def _rosbags(self) -> Any:
        """The type store of rosbags."""
        if self._store is None:
            try:
                from rosbags.typesys import Stores, TypesysError, get_types_from_msg, get_typestore
            except ImportError as error:
                raise TransportUnavailable(
                    "ROS message types need the package rosbags", "install `sleec-runtime[dds]`"
                ) from error
            try:
                store = get_typestore(Stores(f"ros2_{self._distribution}"))
            except ValueError as error:
                raise TransportUnavailable(
                    f"the type store does not know the ROS distribution {self._distribution!r}",
                    "set ROS_DISTRO to humble or jazzy",
                ) from error
            for name, text in self._definitions.items():
                try:
                    store.register(get_types_from_msg(text, name))
                except TypesysError as error:
                    raise InvalidDefinition(
                        f"the definition of message type {name!r} is invalid: {error}",
                        "give the text of its `.msg` file",
                    ) from error
            self._store = store
        return self._store

    def _hint(self, name: str, definitions: Mapping[str, object]) -> str:
        """The hint for an unknown type."""
        from sleec_runtime.support.suggestions import nearest

        near = nearest(name, sorted(definitions))
        return f"did you mean `{near}`?" if near else "give the text of its `.msg` file in `definitions`"
