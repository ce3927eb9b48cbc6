"""Truncated MCAP files: a recorder that crashed wrote no index, and perhaps only a part of its last record.

The format: https://mcap.dev/spec. A record is an opcode (1 byte), the length of its content (8 bytes), and the content.
"""

from __future__ import annotations

import struct
from typing import BinaryIO

from rosbags.rosbag2.errors import ReaderError
from rosbags.rosbag2.storage_mcap import ChunkInfo, McapReader

_MAGIC = b"\x89MCAP0\r\n"
_NOTHING, _FOOTER, _CHUNK, _DATA_END = 0x00, 0x02, 0x06, 0x0F
_HEAD = struct.Struct("<BQ")
_CHUNK_HEAD = struct.Struct("<QQQII")
"""Time of the first and of the last message, uncompressed size, checksum, length of the name of the compression."""


class CutOffError(Exception):
    """The file ends before its first complete message or chunk."""


class McapFile(McapReader):
    """Reads an MCAP file, also a truncated one or one without an index, up to its last complete record.

    `damage` describes what is not read; None if the file is complete.
    """

    damage: str | None = None

    def open(self) -> None:
        """Open the file. Raises CutOffError; or what `McapReader.open` raises, if it cannot be recovered either."""
        try:
            super().open()
        except Exception as problem:  # noqa: BLE001 - rosbags may raise any exception on corrupt data
            self.bio = self.path.open("rb")
            try:
                self._recover(self.bio)
            except CutOffError:
                self.close()
                raise
            except Exception:  # noqa: BLE001
                self.close()
                raise problem from None

    def _recover(self, file: BinaryIO) -> None:
        if file.read(len(_MAGIC)) != _MAGIC:
            raise ReaderError("File magic is invalid.")
        self.data_start = self.data_end = file.tell()
        end = file.seek(0, 2)
        chunks = []
        while self.data_end + _HEAD.size <= end:
            file.seek(self.data_end)
            opcode, size = _HEAD.unpack(file.read(_HEAD.size))
            after = self.data_end + _HEAD.size + size
            if opcode in (_NOTHING, _FOOTER, _DATA_END) or after > end:
                break
            if opcode == _CHUNK:
                chunks.append(_chunk(file, self.data_end, size))
            self.data_end = after
        self.damage = f"it has no valid index: {end - self.data_end} bytes after the last complete record were not read"
        self.meta_scan()
        found = self.statistics
        if found is None or not found.message_count:
            raise CutOffError("it ends before its first complete message or chunk")
        # Without counts of the messages, each chunk may have messages of each channel.
        self.chunks = [chunk._replace(channel_count=dict.fromkeys(self.channels, 1)) for chunk in chunks]
        self.metadata = self.metadata._replace(
            start_time=found.start_time,
            end_time=found.end_time + 1,
            duration=found.end_time + 1 - found.start_time,
            message_count=found.message_count,
        )


def _chunk(file: BinaryIO, offset: int, size: int) -> ChunkInfo:
    """The entry that an index would have for the chunk at `offset`, whose head was read."""
    first, last, uncompressed, _, length = _CHUNK_HEAD.unpack(file.read(_CHUNK_HEAD.size))
    compression = file.read(length).decode()
    (compressed,) = struct.unpack("<Q", file.read(8))
    return ChunkInfo(first, last, offset, size + _HEAD.size, {}, 0, compression, compressed, uncompressed, {})
