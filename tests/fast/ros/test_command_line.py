"""``python -m sleec_runtime.ros``: nodes as processes, and errors of their users."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from sleec_runtime.ros import Network, command_line
from sleec_runtime.ros.command_line import main
from sleec_runtime.ros.dds import transport as dds_transport
from sleec_runtime.ros.in_process import InProcessTransport
from sleec_runtime.ros.messages import ConditionsUpdate, MissionEvent

RULES = "CONDITION Dark\nRULE go WHEN Go THEN Drive UNLESS Dark\n"
MAPPING = '[conditions]\nDark = {topic = "/light", field = "data", below = 3}\n'
TYPES = '[topics]\n"/light" = {type = "std_msgs/msg/Float32"}\n'


@pytest.fixture
def transport(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> InProcessTransport:
    """The transport in the place of DDS, and files in the current folder."""
    monkeypatch.chdir(tmp_path)
    Path("rules.sleec").write_text(RULES)
    Path("untyped.toml").write_text(MAPPING)
    Path("typed.toml").write_text(MAPPING + TYPES)
    transport = Network().transport()
    monkeypatch.setattr(command_line, "_transport", lambda *_: transport)
    return transport


def run(arguments: list[str], meanwhile: Callable[[], object]) -> int:
    """The exit code of a node that Ctrl-C ends after `meanwhile`."""

    def end() -> None:
        meanwhile()
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.2, end)
    timer.start()
    code = main(arguments)
    timer.join()
    return code


def test_a_recorder_and_a_monitor_run_until_a_signal(
    transport: InProcessTransport, caplog: pytest.LogCaptureFixture
) -> None:
    network = transport._network

    def publish() -> None:
        for message in (ConditionsUpdate(conditions={"Dark": False}), MissionEvent(trigger="Go")):
            network.transport().publisher(message.topic).publish(message.to_fields())
        network.deliver()

    handler = signal.getsignal(signal.SIGINT)
    assert run(["record", "log.jsonl", "--rules", "rules.sleec", "--mapping", "typed.toml"], publish) == 0
    assert Path("log.jsonl").read_text().count("\n") == 2
    assert transport.closed
    transport.closed = False
    assert run(["monitor", "rules.sleec", "--tolerance", "0", "--ros-args", "-r", "__ns:=/a"], publish) == 1
    assert "`Drive` has not been executed" in caplog.text
    assert signal.getsignal(signal.SIGINT) is handler


@pytest.mark.parametrize(("option", "seconds"), [(["--settle", "0.2"], 0.2), ([], 0)])
def test_the_transport_of_an_observer_settles(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, option: list[str], seconds: float
) -> None:
    opened = []

    def open_dds(definitions: object, settle: float) -> InProcessTransport:
        opened.append(settle)
        return Network().transport()

    monkeypatch.setattr(dds_transport, "DdsTransport", open_dds)
    assert run(["record", str(tmp_path / "log.jsonl"), *option], lambda: None) == 0
    assert opened == [seconds]


@pytest.mark.parametrize(
    ("option", "problem"),
    [
        (["--settle", "nan"], "settle"),
        (["--settle", "-1"], "settle"),
        (["--settle", "0.2", "--transport", "rclpy"], "--settle needs DDS"),
    ],
)
def test_a_wrong_time_to_settle_is_refused(
    tmp_path: Path, option: list[str], problem: str, caplog: pytest.LogCaptureFixture
) -> None:
    assert main(["record", str(tmp_path / "log.jsonl"), *option]) == 2
    assert problem in caplog.text


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["monitor", "missing.sleec"], "missing.sleec"),
        (["monitor", "rules.sleec", "--mapping", "missing.toml"], "file missing.toml does not exist"),
        (["monitor", "rules.sleec", "--mapping", "untyped.toml"], "the type of the topic `/light` is missing"),
        (["monitor", "rules.sleec", "--tolerance", "-1"], "tolerance"),
        (["record", "log.jsonl", "--mapping", "typed.toml"], "--mapping needs --rules"),
        (["monitor", "rules.sleec", "--mapping", "rules.sleec"], "rules.sleec is not TOML"),
        (["record", "rules.sleec"], "rules.sleec exists"),
        (["record", "no/log.jsonl"], "cannot be written"),
        (["context-manager", "rules.sleec", "--checkpoint", "rules.sleec"], "checkpoint"),
        (["task", "no_such_module:Task"], "'no_such_module:Task' cannot be used: No module named 'no_such_module'"),
        (["task", "json:Task"], "has no attribute 'Task'"),
        (["task", "sleec_runtime.ros:TaskManagerNode"], "missing a required argument: 'sleec'"),
        (["mission", "json:JSONDecoder"], "too many positional arguments"),
        (["mission", ""], "Empty module name"),
        (["mission", ".json:loads"], "'.json:loads' cannot be used"),
        (["task", "builtins:str"], "'builtins:str' cannot be called with one argument"),
        (["task", "builtins:id"], "'builtins:id' is not a node"),
        (["context-manager", "rules.sleec", "--name", "a\udcff"], "name"),
        (["context-manager", "rules.sleec", "--checkpoint", "."], "the checkpoint . cannot be read"),
    ],
)
def test_errors_are_one_line(
    transport: InProcessTransport, arguments: list[str], problem: str, caplog: pytest.LogCaptureFixture
) -> None:
    assert main(arguments) == 2
    (line,) = [record.getMessage() for record in caplog.records]
    assert line.startswith("error: ")
    assert problem in line


def test_a_context_manager_may_be_strict(transport: InProcessTransport, caplog: pytest.LogCaptureFixture) -> None:
    Path("rules.sleec").write_text(RULES.replace("Drive", "Drive WITHIN 5 seconds"))

    def trigger() -> None:
        message = MissionEvent(trigger="Go")
        transport._network.transport().publisher(message.topic).publish(message.to_fields())
        transport._network.deliver()

    assert run(["context-manager", "rules.sleec", "--strict"], trigger) == 0
    assert "the decision for Go depends on unreported values: Dark" in caplog.text


def test_unknown_options_are_a_usage_error(transport: InProcessTransport) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["monitor", "rules.sleec", "--tol", "1"])
    assert caught.value.code == 2


def test_a_problem_of_a_mission_is_one_line(
    transport: InProcessTransport, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    Path("guide.py").write_text("def run(mission):\n    mission.start('Go', {'speed': float('nan')})\n")
    monkeypatch.syspath_prepend(".")
    assert run(["mission", "guide:run"], lambda: None) == 0
    (line,) = [record.getMessage() for record in caplog.records if record.levelname == "ERROR"]
    assert line.startswith("mission: the mission has ended: the message cannot be written as JSON")


def test_a_checkpoint_that_cannot_be_written_is_reported_at_the_start(
    transport: InProcessTransport, caplog: pytest.LogCaptureFixture
) -> None:
    assert run(["context-manager", "rules.sleec", "--checkpoint", "no/checkpoint.json"], lambda: None) == 0
    assert "the checkpoint no/checkpoint.json cannot be written" in caplog.text


@pytest.mark.parametrize(("pause", "code"), [(0.0, 0), (1.1, 130)])
def test_another_signal_ends_code_that_does_not_return(
    transport: InProcessTransport, monkeypatch: pytest.MonkeyPatch, pause: float, code: int
) -> None:
    def start(options: object, connect: object) -> InProcessTransport:
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(pause)
        os.kill(os.getpid(), signal.SIGTERM)
        return transport

    monkeypatch.setattr(command_line, "_task", start)
    assert main(["task", "the:code"]) == code
