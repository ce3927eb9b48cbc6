"""Two hosts: discovery by multicast, as ROS 2 does it, and a cable that is pulled out and put in again."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from queue import SimpleQueue

from tests.support.dds import PATIENCE, require_dds
from tests.support.network_namespaces import Host
from tests.support.network_namespaces import hosts as hosts
from tests.support.paths import ROOT

require_dds()

# Discovery by multicast is the default; only its intervals are shorter, so that the test is short.
INTERVALS = """<CycloneDDS><Domain><Discovery>
<SPDPInterval>200 ms</SPDPInterval><LeaseDuration>2 s</LeaseDuration>
</Discovery></Domain></CycloneDDS>"""


class Line:
    """A process on a host, see tests/support/dds_line.py."""

    def __init__(self, host: Host, outgoing: str, incoming: str) -> None:
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "ROS_DOMAIN_ID": "0", "CYCLONEDDS_URI": INTERVALS}
        command = [sys.executable, "-m", "tests.support.dds_line", outgoing, incoming]
        self.process: subprocess.Popen[str] = host.start(command, environment)
        self._lines: SimpleQueue[str] = SimpleQueue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line.strip())

    def write(self, text: str) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(f"{text}\n")

    def await_lines(self, *expected: str) -> None:
        """Waits until the process has written these lines, in any order."""
        missing = list(expected)
        while missing:
            line = self._lines.get(timeout=PATIENCE)
            if line in missing:
                missing.remove(line)

    def end(self) -> None:
        self.process.kill()
        self.process.wait()
        self._reader.join()
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.close()
        self.process.stdout.close()


def test_hosts_find_each_other_also_after_a_partition(hosts) -> None:
    first, second = hosts
    here, there = Line(first, "/a", "/b"), Line(second, "/b", "/a")
    try:
        here.await_lines("found")
        there.await_lines("found")
        here.write("one")
        there.await_lines("one")
        first.disconnect()
        here.write("two")
        # Both sides notice that the other one is gone.
        here.await_lines("lost")
        there.await_lines("lost")
        here.write("three")
        first.connect()
        # The last message of the latched topic arrives when the hosts have found each other again.
        there.await_lines("found", "three")
        there.write("four")
        here.await_lines("found", "four")
    finally:
        here.end()
        there.end()
