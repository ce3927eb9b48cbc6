"""ROS 2 bags: folders with metadata.yaml, and single files in the storage formats MCAP and SQLite.

The time of a message is the time at which the recorder received it. Timestamps in messages are not used.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction
from heapq import merge
from itertools import islice
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote, unquote

from rosbags.interfaces import Connection
from rosbags.rosbag2.reader import DirectoryReader
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Reader

from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.errors import UnreadableLog
from sleec_runtime.support.messages import represent
from sleec_verify.audit.readers.mcap_recovery import CutOffError, McapFile
from sleec_verify.audit.readers.message_types import MessageTypes, Undecodable, UnknownType
from sleec_verify.audit.readers.reader import Item, Position, Unreadable

_METADATA = "metadata.yaml"
_PER_SECOND = 10**9


class _SqliteFile(Sqlite3Reader):
    damage: str | None = None

    def __init__(self, path: Path) -> None:
        # rosbags does not escape `?` and `#` when it puts the path into a URI.
        super().__init__(Path(quote(str(path))))
        waiting = path.with_name(f"{path.name}-wal")
        if waiting.exists() and waiting.stat().st_size:
            self.damage = f"its last messages are in {waiting.name}, which is not read; merge both with sqlite3"


class _Folder(DirectoryReader):
    STORAGE_PLUGINS = {"mcap": McapFile, "sqlite3": _SqliteFile}  # noqa: RUF012 - as in the base class


class _Message(NamedTuple):
    """A message as the recorder received it, or the end of what can be read of a file."""

    time: int
    connection: Connection | None
    data: bytes
    damage: Unreadable | None = None


class RosBag:
    """The recording at `path`: a folder, or one file. Only messages on `topics` are decoded; None: all. The attribute
    `topics` has all topics of the recording.

    A position has the time of the last message in nanoseconds, and how many messages on `topics` have exactly that
    time.
    """

    def __init__(self, path: Path, topics: Collection[str] | None = None) -> None:
        self.path = path
        self.topics: frozenset[str] = frozenset()
        self._wanted = topics
        self._span: tuple[int, int] | None = None

    def read(self, start: Position = None) -> Iterator[tuple[Position, Item]]:
        """See `Reader.read`. Messages are in chronological order, also if the bag has several files."""
        bag = self._open()
        try:
            files = [file.metadata for file in _files(bag)]
            first = min((file.start_time for file in files), default=0)
            last = max((file.end_time for file in files), default=0)
            self._span = first, last
            self.topics = frozenset(one.topic for one in bag.connections)
            now, count = (first, 0) if start is None else self._parts_of(start)
            if start is not None and not first <= now <= last:
                problem = f"{self.path} has changed since the position was saved"
                raise UnreadableLog(problem, "audit it from the beginning")
            types = MessageTypes(bag.metadata.ros_distro, bag.metadata.compression_mode == "message")
            unknown: set[str] = set()
            skipped = 0 if start is None else count
            for message in self._messages(bag, None if start is None else now):
                if message.connection is None:
                    assert message.damage is not None
                    yield {"time": now, "messages": count}, message.damage
                elif skipped and message.time == now:
                    skipped -= 1
                else:
                    now, count, skipped = message.time, count + 1 if message.time == now else 1, 0
                    item = _item(message, types, unknown)
                    if item is not None:
                        yield {"time": now, "messages": count}, item
        finally:
            bag.close()

    def fraction(self, position: Position) -> float:
        """See `Reader.fraction`."""
        if position is None or self._span is None:
            return 0.0
        first, last = self._span
        return (self._parts_of(position)[0] - first) / max(1, last - first)

    def sample(self, each: int) -> Iterator[Item]:
        """The first `each` messages of each topic in each file. The index of the recording makes this fast."""
        bag = self._open()
        try:
            types = MessageTypes(bag.metadata.ros_distro, bag.metadata.compression_mode == "message")
            unknown: set[str] = set()
            for file in _files(bag):
                for connection in file.connections:
                    for message in islice(self._of_file(file, None, [connection]), each):
                        item = message.damage or _item(message, types, unknown)
                        if item is not None:
                            yield item
        finally:
            bag.close()

    def _parts_of(self, position: Position) -> tuple[int, int]:
        """The time and the number of messages in a position."""
        time, count = (position.get("time"), position.get("messages")) if isinstance(position, dict) else (None, None)
        if not (isinstance(time, int) and isinstance(count, int)):
            raise UnreadableLog(f"{represent(position)} is not a position in {self.path}")
        return time, count

    def _open(self) -> Any:
        """The opened reader of rosbags."""
        path = self.path
        try:
            if path.is_dir():
                if not (path / _METADATA).exists():
                    raise UnreadableLog(
                        f"the folder {path} has no file {_METADATA}",
                        "name a .mcap or .db3 file in it, or run `ros2 bag reindex`",
                    )
                bag: Any = _Folder(path)
            elif path.suffix == ".mcap":
                bag = McapFile(path)
            else:
                bag = _SqliteFile(path)
            bag.open()
            _check_types(bag)
        except UnreadableLog:
            raise
        except FileNotFoundError:
            raise UnreadableLog(f"file {path} does not exist", "check its name and folder") from None
        except CutOffError as error:
            raise UnreadableLog(
                f"{path} has no messages to recover: {error}", "the recorder may have crashed"
            ) from None
        except Exception as error:  # noqa: BLE001 - rosbags may raise any exception on corrupt data
            raise UnreadableLog(
                f"{path} cannot be read as a ROS 2 bag: {_reason(error)}", "run `ros2 bag info` for details"
            ) from None
        return bag

    def _messages(self, bag: Any, start: int | None) -> Iterator[_Message]:
        """The messages of all files, from the time `start` on."""
        streams = []
        for file in _files(bag):
            wanted = [one for one in file.connections if self._wanted is None or one.topic in self._wanted]
            streams.append(self._of_file(file, start, wanted))
        return merge(*streams, key=itemgetter(0))

    def _of_file(self, file: Any, start: int | None, wanted: Sequence[Connection]) -> Iterator[_Message]:
        """The messages of one file on some connections, and last its damage, if any."""
        at = file.metadata.start_time
        problem = None
        try:
            for connection, time, data in file.messages(wanted, start) if wanted else ():
                at = _time(time)
                yield _Message(at, connection, data)
        except Exception as error:  # noqa: BLE001 - rosbags may raise any exception on corrupt data
            problem = f"it is damaged after this time, and not read further: {_reason(error)}"
        problem = problem or file.damage
        if problem is not None:
            place = f"{unquote(file.path.name)} at {_seconds(at)}"
            yield _Message(at, None, b"", Unreadable(place, problem, "the recorder may have crashed"))


def _files(bag: Any) -> list[Any]:
    """The readers of the files of a recording."""
    files: list[Any] = getattr(bag, "storages", [bag])
    return files


def _check_types(bag: Any) -> None:
    """Checks what rosbags does not: YAML and SQLite may have values of any type everywhere. Raises TypeError."""
    try:
        for file in _files(bag):
            for time in (file.metadata.start_time, file.metadata.end_time):
                _time(time)
            for one in (*bag.connections, *file.connections):
                for name in (one.topic, one.msgtype):
                    if not isinstance(name, str):
                        raise TypeError(f"{represent(name)} is not the name of a topic or type")
    except TypeError:
        bag.close()
        raise


def _time(value: object) -> int:
    if type(value) is not int:
        raise TypeError(f"{represent(value)} is not a time in nanoseconds")
    return value


def _item(message: _Message, types: MessageTypes, unknown: set[str]) -> Item | None:
    """The message with its fields; None if its type is in `unknown`. Adds each new unknown type to `unknown`."""
    connection = message.connection
    assert connection is not None
    time = Fraction(message.time, _PER_SECOND)
    try:
        if connection.msgtype in unknown:
            return None
        if time < 0:
            raise Undecodable("its time is negative")
        return RawMessage(time, connection.topic, connection.msgtype, types.decode(connection, message.data))
    except UnknownType as problem:
        unknown.add(connection.msgtype)
        return Unreadable(
            f"the messages on {represent(connection.topic)}",
            str(problem),
            "record with a distribution that stores message definitions, or convert the log to JSON lines",
        )
    except Undecodable as problem:
        place = f"the message on {represent(connection.topic)} at {_seconds(message.time)}"
        return Unreadable(place, f"it is not a {represent(connection.msgtype)}: {problem}")


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds // _PER_SECOND}.{nanoseconds % _PER_SECOND:09d} s"


def _reason(error: Exception) -> str:
    return f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
