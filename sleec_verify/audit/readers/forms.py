"""The reader of a log: its form follows from its name."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.readers.json_lines import JsonLines
from sleec_verify.audit.readers.reader import Reader


def open_log(path: Path, topics: Collection[str] | None = None) -> Reader:
    """The reader of the log at `path`: a ROS 2 bag if it is a folder or ends with .mcap or .db3, a Parquet table if it
    ends with .parquet, and JSON lines otherwise.

    Messages on topics that are not in `topics` may be skipped; None: all topics are read.

    Raises:
        UnreadableLog: the log is a pipe or device, a library for this form is not installed, or the form is not
            supported. A missing log is reported when it is read.
    """
    _require_files(path)
    try:
        if path.is_dir() or path.suffix in (".mcap", ".db3"):
            from sleec_verify.audit.readers.rosbag2 import RosBag

            return RosBag(path, topics)
        if path.suffix == ".parquet":
            from sleec_verify.audit.readers.parquet import Parquet

            return Parquet(path, topics)
    except ImportError as error:
        problem = f"reading {path} needs a library that is not installed: {error.name}"
        raise UnreadableLog(problem, "install the extra `logs` of sleec-verify") from None
    if path.suffix == ".bag":
        raise UnreadableLog(f"{path} is a ROS 1 bag", "convert it with `rosbags-convert`")
    if path.suffix == ".zstd":
        raise UnreadableLog(f"{path} is one compressed file of a bag", "name the folder with its metadata.yaml")
    return JsonLines(path)


def _require_files(path: Path) -> None:
    """Rejects a pipe or device, and a folder with one: opening a pipe waits for a writer. Raises UnreadableLog."""
    try:
        for file in path.iterdir() if path.is_dir() else [path]:
            if file.exists() and not (file.is_file() or file.is_dir()):
                raise UnreadableLog(f"{file} is not a regular file")
    except OSError as problem:
        raise UnreadableLog(f"{path} cannot be read: {problem.strerror}") from None
