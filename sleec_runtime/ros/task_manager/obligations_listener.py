"""The obligations of rules with time, which the Context Manager starts in the process of a task."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from sleec_runtime.dispatch.recording import recording
from sleec_runtime.errors import SleecError
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.ros.messages import Completed, Executed, Start
from sleec_runtime.ros.node import Node
from sleec_runtime.ros.task_manager.layer_listener import LayerListener
from sleec_runtime.timed.failures import raise_interrupt

MOST = 10_000
"""The number of starts that a task remembers."""


@dataclass
class _Run:
    """A start, the time at which it arrived, and whether its obligation is done."""

    start: Start
    arrived: float
    is_completed: bool = False


class ObligationsListener:
    """Runs the callable of each obligation that is started and that this task implements, once for each start.

    It ignores starts while the task is out of step, and starts that are older than the last heartbeats, because the
    Context Manager repeats the starts of pending obligations. `on_error` gets the error of a callable, and returns it
    as text.
    """

    def __init__(
        self, node: Node, sleec: Sleec, layers: LayerListener, on_error: Callable[[str, BaseException], str]
    ) -> None:
        self._node = node
        self._sleec = sleec
        self._layers = layers
        self._on_error = on_error
        self._lock = threading.Lock()
        self._runs: OrderedDict[str, _Run] = OrderedDict()
        self._send = node.sender(Completed)
        self._report = node.sender(Executed)
        node.listen(Start, self._receive)

    def complete(self, obligation: str) -> None:
        """The obligation is done, for all its starts that are under way. Raises SleecError if there is none."""
        with self._lock:
            runs = [run for run in self._runs.values() if run.start.obligation == obligation and not run.is_completed]
            for run in runs:
                run.is_completed = True
        if not runs:
            raise SleecError(f"`{obligation}` is not under way", "report it once, when it is done")
        self._report_end(runs[-1], due=(obligation,), executed=(obligation,))
        for run in runs:
            self._send_completed(run.start)

    def _receive(self, start: Start) -> None:
        code, watch = self._sleec.code, self._layers.watch
        function = code.implementation(start.obligation)
        if function is None or not self._layers.in_step or start.manager != watch.followed:
            return
        with self._lock:
            known = self._runs.get(start.id)
            if known is None and start.beat >= watch.beat() - 1:
                run = self._runs[start.id] = _Run(start, time.time())
                if len(self._runs) > MOST:
                    self._runs.popitem(last=False)
            elif known is None or not known.is_completed:
                return
        if known is not None:
            # The report was lost, or has not arrived yet.
            self._send_completed(start)
            return
        with recording(apart=True) as seen:
            try:
                function(start.arguments)
            except BaseException as error:  # noqa: BLE001 - reported
                others = tuple(name for name in seen.executed if name != start.obligation)
                self._report_end(run, executed=others, failed=self._on_error(start.obligation, error))
                raise_interrupt(error)
                return
        others = tuple(name for name in seen.executed if name != start.obligation)
        if others:
            self._report_end(run, executed=others)
        if start.obligation not in code.takes_time and not run.is_completed:
            self.complete(start.obligation)

    def _send_completed(self, start: Start) -> None:
        self._send(Completed(node=self._node.name, id=start.id, obligation=start.obligation))

    def _report_end(
        self, run: _Run, executed: tuple[str, ...], due: tuple[str, ...] = (), failed: str | None = None
    ) -> None:
        self._report(
            Executed(
                node=self._node.name,
                triggered=run.arrived,
                time=time.time(),
                due=due,
                executed=executed,
                manager=run.start.manager,
                number=run.start.number,
                failed=failed,
            )
        )
