"""The types of the messages in a ROS bag: those that the bag defines, and the standard ones of a ROS distribution."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any

from backports import zstd
from rosbags.interfaces import Connection, MessageDefinition, MessageDefinitionFormat
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from sleec_runtime.support.messages import represent
from sleec_verify.audit.readers.message_fields import MessageFields

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_IDL_SEPARATOR = "=" * 80 + "\n"


class UnknownType(Exception):
    """A message type without a usable definition."""


class Undecodable(Exception):
    """Bytes that are not a message of their type."""


class MessageTypes:
    """Decodes messages. A definition in the bag takes precedence over the standard one, and is read when it is used.

    `distribution` is the ROS distribution of the recorder, such as ``humble``. Without a text, the standard types are
    those of the newest distribution. With `is_compressed`, each message is compressed with zstd.
    """

    def __init__(self, distribution: object, is_compressed: bool = False) -> None:
        self._distribution = distribution if isinstance(distribution, str) else None
        self._is_compressed = is_compressed
        self._stores: dict[tuple[str, MessageDefinition], Typestore] = {}

    def decode(self, connection: Connection, data: bytes) -> Mapping[str, object]:
        """The fields of a message.

        Raises:
            UnknownType: for every message of this connection.
            Undecodable: for this message.
        """
        key = connection.msgtype, connection.msgdef
        if key not in self._stores:
            self._stores[key] = self._store(connection)
        store = self._stores[key]
        try:
            if self._is_compressed:
                data = zstd.decompress(data)
            message = store.deserialize_cdr(data, connection.msgtype)
        except Exception as error:  # noqa: BLE001 - generated code may raise any exception on corrupt data
            raise Undecodable(f"{type(error).__name__}: {error}") from None
        return MessageFields(message, store)

    def _store(self, connection: Connection) -> Typestore:
        name, definition = connection.msgtype, connection.msgdef
        encoding = getattr(connection.ext, "serialization_format", "cdr")
        if encoding != "cdr":
            raise UnknownType(f"their encoding is {represent(encoding)}, not `cdr`")
        if definition.format == MessageDefinitionFormat.NONE:
            store = _standard_types(self._distribution)
            if name not in store.fielddefs:
                raise UnknownType(f"the log has no definition of {represent(name)}, and it is not a standard type")
            return store
        try:
            return _own_types(name, definition)
        except Exception as error:  # noqa: BLE001 - the parser may raise any exception
            reason = f"{type(error).__name__}: {error}"
            raise UnknownType(f"the definition of {represent(name)} in the log cannot be used: {reason}") from None


@lru_cache(maxsize=256)
def _own_types(name: str, definition: MessageDefinition) -> Typestore:
    """The types of a definition. The parser is slow, and the logs of a fleet have the same types."""
    store = get_typestore(Stores.EMPTY)
    store.register(_parsed(definition.format, definition.data, name))
    store.get_msgdef(name)
    return store


def _parsed(form: MessageDefinitionFormat, text: str, name: str) -> Any:
    if form == MessageDefinitionFormat.MSG:
        return get_types_from_msg(text, name)
    parts = [text]
    if text.startswith(f"{_IDL_SEPARATOR}IDL: "):
        parts = [part.split("\n", 1)[1] for part in text.split(_IDL_SEPARATOR)[1:]]
    return {key: found for part in parts for key, found in get_types_from_idl(part).items()}


@cache
def _standard_types(distribution: str | None) -> Typestore:
    known = {store.value: store for store in Stores}
    return get_typestore(known.get(f"ros2_{distribution}", Stores.LATEST))
