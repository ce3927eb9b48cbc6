"""The command, in a process of its own: start, Ctrl-C, kill, and what cannot be served."""

from __future__ import annotations

import json
import re
import signal
import socket
import subprocess
import sys
from http.client import HTTPConnection
from pathlib import Path

import pytest

from benchmarks.random_rules import random_rules
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.servers import server_on


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.sleec"
    path.write_text("WHEN A THEN B\n", encoding="utf-8")
    return path


def test_ctrl_c_ends_the_server_without_a_message(rules: Path) -> None:
    with server_on(rules) as server:
        assert server.host == "127.0.0.1"
        assert server.request("file")["text"] == "WHEN A THEN B\n"
        server.process.send_signal(signal.SIGINT)
        out, err = server.process.communicate(timeout=60)
        assert (out, server.process.returncode) == ("", 0)
        assert "Traceback" not in err


def test_a_draft_survives_a_killed_server(rules: Path) -> None:
    with server_on(rules) as server:
        based_on = server.request("file")["sha256"]
        server.request("draft", {"text": "WHEN A TH", "based_on": based_on})
        server.process.kill()
        server.process.wait()
    with server_on(rules) as server:
        assert server.request("file")["draft"] == {"text": "WHEN A TH", "based_on": based_on}
        assert server.request("file")["text"] == "WHEN A THEN B\n"


def test_a_restart_keeps_the_port_if_it_is_free(rules: Path) -> None:
    with server_on(rules) as first:
        first.process.kill()
        first.process.wait()
    with server_on(rules) as again, server_on(rules) as other:
        assert again.port == first.port != other.port
        assert len({first.token, again.token, other.token}) == 3


def test_the_command_of_the_documentation(tmp_path: Path) -> None:
    (line,) = re.findall(
        r"```sh\nsleec-verify serve (.+)\n```", (ROOT / "docs" / "serve.md").read_text(encoding="utf-8")
    )
    path = tmp_path / "rules.sleec"
    path.write_bytes((ROOT / line).read_bytes())
    with server_on(path) as server:
        assert server.request("file")["name"] == "rules.sleec"


def test_a_busy_port(rules: Path, cli: Cli) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        ran = cli("serve", str(rules), "--port", str(port), "--no-browser")
    assert ran.code == 2
    assert f"port {port} is in use" in ran.err


def test_what_is_not_there_or_not_a_file(rules: Path, cli: Cli) -> None:
    missing = cli("serve", "none.sleec").err
    assert "file none.sleec does not exist" in missing
    assert "for new rules, create an empty file first" in missing
    assert "a folder" in cli("serve", str(rules.parent)).err
    assert "standard input" in cli("serve", "-").err


@pytest.mark.parametrize("missing", ["starlette", "uvicorn", "anyio"])
def test_without_the_extra(rules: Path, missing: str) -> None:
    run = f"import sys; sys.modules[{missing!r}] = None; from sleec_verify.cli import main; main()"
    ran = subprocess.run(
        [sys.executable, "-c", run, "serve", str(rules)], capture_output=True, text=True, check=False, timeout=60
    )
    assert ran.returncode == 2
    assert "pip install 'sleec-verify[serve]'" in ran.stderr


def test_ctrl_c_ends_a_long_check_without_a_message(rules: Path) -> None:
    with server_on(rules) as server:
        text = random_rules(4_000, hedges=1)
        connection = HTTPConnection(server.host, server.port, timeout=60)
        connection.request("POST", "/api/check", json.dumps({"text": text}), {"X-Sleec-Token": server.token})
        server.request("disk")  # the server has read the first request
        server.process.send_signal(signal.SIGINT)
        out, err = server.process.communicate(timeout=60)
        connection.close()
    assert (out, server.process.returncode) == ("", 0)
    assert err.splitlines() == [f"{rules}: open the address above; press Ctrl-C to stop"]
    assert [one.name for one in rules.parent.iterdir() if one.name.startswith(".")] == []
