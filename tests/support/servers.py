"""A server in a process of its own, as a user starts it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit


class Server:
    """A running server, and requests to it."""

    def __init__(self, process: subprocess.Popen[str], address: str) -> None:
        self.process = process
        self.address = address
        parts = urlsplit(address)
        assert parts.hostname is not None
        self.host, self.port = parts.hostname, parts.port
        (self.token,) = parse_qs(parts.query)["token"]

    def request(self, name: str, fields: object = None) -> Any:
        """The answer to a request below ``/api/``."""
        connection = HTTPConnection(self.host, self.port, timeout=60)
        method, content = ("GET", None) if fields is None else ("POST", json.dumps(fields))
        connection.request(method, f"/api/{name}", content, {"X-Sleec-Token": self.token})
        answer = connection.getresponse()
        assert answer.status == 200, answer.read()
        found = json.loads(answer.read())
        connection.close()
        return found


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "sleec_verify", "serve", *arguments, "--no-browser"]


@contextmanager
def server_on(path: Path, *arguments: str) -> Iterator[Server]:
    """A server with its drafts in the folder of `path`."""
    environment = {**os.environ, "XDG_STATE_HOME": str(path.parent / "state")}
    with subprocess.Popen(
        command(str(path), *arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as process:
        try:
            assert process.stdout is not None
            yield Server(process, process.stdout.readline().strip())
        finally:
            process.kill()
