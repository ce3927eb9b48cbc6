"""Logs as Parquet tables: each row corresponds to a JSON line, and each column to a key (docs/audit-logs.md)."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from sleec_runtime.audit.observation import MalformedValues, observation_of, read_json
from sleec_runtime.errors import MalformedObservation, UnreadableLog
from sleec_runtime.support.messages import represent
from sleec_verify.audit.readers.reader import Item, Position, Unreadable

_AS_JSON = ("conditions", "message")
_CONTENTS = ("domain", "event", "executed", *_AS_JSON)
_COLUMNS = ("time", "topic", "type", *_CONTENTS)
_ROWS = 4096
"""The batch size in rows. In memory are one batch and one page of each column."""
_PER_SECOND = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}


class Parquet:
    """The table at `path`. Only messages on `topics` are parsed; None: all. A position is the number of rows before
    it."""

    def __init__(self, path: Path, topics: Collection[str] | None = None) -> None:
        self.path = path
        self._topics = topics
        self._rows = 0

    def read(self, start: Position = None) -> Iterator[tuple[Position, Item]]:
        """See `Reader.read`."""
        try:
            file = pq.ParquetFile(self.path)
        except FileNotFoundError:
            raise UnreadableLog(f"file {self.path} does not exist", "check its name and folder") from None
        except (OSError, ValueError, NotImplementedError) as error:  # errors of Arrow are ValueErrors
            raise UnreadableLog(f"{self.path} cannot be read as a Parquet file: {error}") from None
        with file:
            self._rows = file.metadata.num_rows
            columns = self._columns(file.schema_arrow)
            row = 0 if start is None else self._row(start)
            try:
                for batch in _batches(file, columns, row):
                    for values in _rows(batch):
                        row += 1
                        if self._topics is None or values.get("topic", "") in ("", *self._topics):
                            yield row, _item(values, row)
            except (OSError, ValueError, NotImplementedError) as error:
                problem = f"the file is damaged, and not read further: {error}"
                yield row, Unreadable(f"row {row + 1}", problem)

    def fraction(self, position: Position) -> float:
        """See `Reader.fraction`."""
        return self._row(position) / self._rows if position is not None and self._rows else 0.0

    def _row(self, position: Position) -> int:
        if not isinstance(position, int):
            raise UnreadableLog(f"{represent(position)} is not a position in a Parquet file")
        if not 0 <= position <= self._rows:
            raise UnreadableLog(f"{self.path} has changed since the position was saved", "audit it from the beginning")
        return position

    def _columns(self, schema: Any) -> list[str]:
        """The columns to read. Raises UnreadableLog for missing columns and for other types."""
        found = [name for name in _COLUMNS if name in schema.names]
        if "time" not in found or not any(name in found for name in _CONTENTS):
            missing = "time" if "time" not in found else " or ".join(_CONTENTS)
            raise UnreadableLog(
                f"{self.path} has no column {missing}", "see docs/audit-logs.md for the columns of a log"
            )
        for name in found:
            if schema.names.count(name) > 1:
                raise UnreadableLog(f"{self.path} has more than one column {name}", "rename all but one")
            kind = schema.field(name).type
            expected = "a number or a timestamp" if name == "time" else "text"
            if not (_is_time(kind) if name == "time" else _is_text(kind)):
                hint = "write a JSON object as text" if name in _AS_JSON else None
                raise UnreadableLog(f"{self.path}: the column {name} is {expected}; got {kind}", hint)
        return found


def _is_time(kind: Any) -> bool:
    types = pa.types
    return any(is_it(kind) for is_it in (types.is_integer, types.is_floating, types.is_decimal, types.is_timestamp))


def _is_text(kind: Any) -> bool:
    types = pa.types
    if types.is_dictionary(kind):
        kind = kind.value_type
    return any(is_it(kind) for is_it in (types.is_string, types.is_large_string, types.is_null))


def _batches(file: Any, columns: list[str], row: int) -> Iterator[Any]:
    """The rows from `row` on. Row groups before it are not read."""
    groups = [file.metadata.row_group(group).num_rows for group in range(file.num_row_groups)]
    first = 0
    while first < len(groups) and row >= groups[first]:
        row -= groups[first]
        first += 1
    for batch in file.iter_batches(_ROWS, range(first, len(groups)), columns):
        if row < batch.num_rows:
            yield batch.slice(row)
        row = max(0, row - batch.num_rows)


def _rows(batch: Any) -> Iterator[dict[str, Any]]:
    """The values of each row that are not null."""
    kind = batch.schema.field("time").type
    is_stamp = pa.types.is_timestamp(kind)
    columns = {
        name: (column.cast(pa.int64()) if is_stamp and name == "time" else column).to_pylist()
        for name, column in zip(batch.schema.names, batch.columns)
    }
    for row in range(batch.num_rows):
        values = {name: column[row] for name, column in columns.items() if column[row] is not None}
        if is_stamp and "time" in values:
            values["time"] = Fraction(values["time"], _PER_SECOND[kind.unit])
        yield values


def _item(values: dict[str, Any], row: int) -> Item:
    """The observation in a row. An empty string in the column `domain` means no domain."""
    try:
        for name in _AS_JSON:
            if name in values:
                values[name] = read_json(values[name])
        if values.get("domain") == "":
            values["domain"] = None
        return observation_of(values)
    except (ValueError, ArithmeticError, RecursionError) as problem:
        return Unreadable(f"row {row}", f"its JSON cannot be read: {problem}")
    except MalformedObservation as error:
        rest = error.rest if isinstance(error, MalformedValues) else None
        return Unreadable(f"row {row}", error.message, error.hint, rest=rest)
