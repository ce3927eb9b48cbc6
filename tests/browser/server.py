"""A server in a process of its own, as a user starts it."""

from __future__ import annotations

import os
import subprocess
import sys
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from urllib.parse import urlsplit


class Server:
    """`sleec-verify serve` for the file at `path`, with drafts beside it."""

    def __init__(self, path: Path, port: int = 0) -> None:
        self.path = path
        environment = {**os.environ, "XDG_STATE_HOME": str(path.parent / "state"), "SLEEC_VERIFY_CACHE": "off"}
        command = [sys.executable, "-m", "sleec_verify", "serve", str(path), "--no-browser", "--port", str(port)]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
        assert self._process.stdout is not None
        self.address = self._process.stdout.readline().strip()
        assert self.address, "the server prints its address"

    @property
    def port(self) -> int:
        port = urlsplit(self.address).port
        assert port is not None
        return port

    def kill(self) -> None:
        """End it without a chance to save anything."""
        self._process.kill()
        self._process.wait()
        assert self._process.stdout is not None
        self._process.stdout.close()


class Recorder:
    """Another program at a port. It answers everything alike, and records what it gets: path, token and content."""

    def __init__(self, port: int) -> None:
        self.requests: list[tuple[str, str | None, bytes]] = []
        record = self.requests.append

        class Handler(BaseHTTPRequestHandler):
            def handle_one_request(self) -> None:
                self.raw_requestline = self.rfile.readline()
                if not self.raw_requestline or not self.parse_request():
                    return
                content = self.rfile.read(int(self.headers.get("Content-Length", 0)))
                record((urlsplit(self.path).path, self.headers.get("X-Sleec-Token"), content))
                answer = b'{"salt": "00", "response": "00"}'
                self.send_response(200)
                self.send_header("Content-Length", str(len(answer)))
                self.end_headers()
                self.wfile.write(answer)

            def log_message(self, *_: object) -> None:
                pass

        self._server = ThreadingHTTPServer(("127.0.0.1", port), Handler)
        self._server.daemon_threads = True

    def __enter__(self) -> Recorder:
        Thread(target=self._server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()
        self._server.server_close()
