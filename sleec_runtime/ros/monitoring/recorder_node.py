"""The recorder node: it writes the messages of topics to a log, which `sleec-verify audit` reads."""

from __future__ import annotations

import os
import threading
from collections import Counter
from collections.abc import Iterable, Mapping
from contextlib import suppress
from functools import partial

from sleec_runtime.audit.log_file import LogFile
from sleec_runtime.audit.observation import LONGEST_LINE, RawMessage, write_line, write_loss
from sleec_runtime.errors import MalformedObservation, UnwritableLog
from sleec_runtime.ros.monitoring.live_topics import RECORDED
from sleec_runtime.ros.monitoring.wall_clock import WallClock
from sleec_runtime.ros.node import Node, OnProblem
from sleec_runtime.ros.transport import Fields, Topic, Transport
from sleec_runtime.support.messages import represent
from sleec_runtime.timed.clock import Clock


class RecorderNode(Node):
    """Records the messages on `topics`, by default those of our nodes, each with the time at which it arrives.

    A message that cannot be written, such as when the disk is full, is lost. Each problem is reported once, `lost`
    counts the messages, and the log records the number of missing messages after the next message.

    `clock` gives the times, in seconds since 1970. See `LogFile` for `path` and `append`. Raises UnwritableLog, and as
    `transport.subscribe`.
    """

    def __init__(
        self,
        transport: Transport,
        path: str | os.PathLike[str],
        topics: Iterable[Topic] = RECORDED,
        *,
        append: bool = False,
        name: str = "recorder",
        clock: Clock | None = None,
        on_problem: OnProblem | None = None,
    ) -> None:
        super().__init__(name, transport, clock or WallClock(), on_problem)
        self._lock = threading.Lock()
        self._file = LogFile(path, append)
        self._missing = 0
        self.recorded = 0
        """The number of messages in the log that this node has written."""
        self.lost: Counter[str] = Counter()
        """The number of lost messages, by problem."""
        with self.starting():
            for topic in topics:
                transport.subscribe(topic, partial(self._record, topic))

    def close(self) -> None:
        """Ends the recording. The transport stays open."""
        with self._lock:
            if not self.closed:
                super().close()
                with suppress(OSError):
                    self._write_loss()
                self._file.close()

    def _record(self, topic: Topic, fields: Fields) -> None:
        with self._lock:
            if self.closed:
                return
            try:
                if not isinstance(fields, Mapping):
                    raise MalformedObservation(f"it is {represent(fields)}, not a mapping of fields")
                line = write_line(RawMessage(self.exact_time(), topic.name, topic.type, fields))
                if len(line) >= LONGEST_LINE:
                    raise MalformedObservation(f"it is longer than {LONGEST_LINE // 2**20} MiB")
                self._file.write(line)
                self.recorded += 1
            except MalformedObservation as error:
                self._lose(f"a message on {topic.name} cannot be recorded", error.message)
            except OSError as error:
                self._lose(f"{self._file.path} cannot be written", str(error.strerror))
            else:
                with suppress(OSError):
                    self._write_loss()

    def _lose(self, problem: str, detail: str) -> None:
        self._missing += 1
        self.lost[problem] += 1
        if self.lost[problem] == 1:
            self.report(UnwritableLog(f"{problem}: {detail}"))

    def _write_loss(self) -> None:
        """Writes how many messages are missing. Not before another line: the first one shows the form of the log."""
        if self._missing:
            self._file.write(write_loss(self.exact_time(), self._missing))
            self._missing = 0
