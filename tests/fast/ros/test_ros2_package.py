"""The ROS 2 package: its files agree, its programs run against the fake of rclpy, and its launch file starts them."""

from __future__ import annotations

import runpy
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import pytest

import sleec_runtime
from sleec_runtime.ros import MissionManagerNode, Topic
from sleec_runtime.ros.messages import Executed, LayersUpdate
from sleec_runtime.ros.rclpy_transport import RclpyTransport
from tests.support.dds import eventually
from tests.support.fake_rclpy import Node
from tests.support.fake_rclpy import rclpy_nodes as rclpy_nodes
from tests.support.paths import ROOT

PACKAGE = ROOT / "ros2/sleec_ros"
RULES = str(ROOT / "rulesets/care-robot.sleec")


@pytest.fixture
def setup(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """The arguments of `setup` in setup.py."""
    given: dict[str, Any] = {}
    fake = ModuleType("setuptools")
    fake.setup = lambda **arguments: given.update(arguments)  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "setuptools", fake)
    runpy.run_path(str(PACKAGE / "setup.py"))
    return given


def test_the_files_of_the_package_agree(setup: dict[str, Any]) -> None:
    package = ElementTree.parse(PACKAGE / "package.xml").getroot()
    name, version = package.findtext("name"), package.findtext("version")
    assert name == setup["name"] == PACKAGE.name
    assert version == setup["version"] == sleec_runtime.__version__
    assert package.attrib == {"format": "3"}
    assert package.findtext("export/build_type") == "ament_python"
    assert {one.text for one in package.findall("exec_depend")} >= {"rclpy", "rosidl_runtime_py", "std_msgs"}
    assert [one for one in setup["packages"] if not (PACKAGE / one / "__init__.py").is_file()] == []
    for folder, files in setup["data_files"]:
        assert folder.startswith("share/")
        assert [one for one in files if not (PACKAGE / one).is_file()] == []
    assert dict(setup["data_files"])["share/ament_index/resource_index/packages"] == [f"resource/{name}"]
    scripts = (PACKAGE / "setup.cfg").read_text(encoding="utf-8")
    assert scripts.count(f"=$base/lib/{name}\n") == 2


def test_the_entry_points_exist(setup: dict[str, Any], programs: ModuleType) -> None:
    points = setup["entry_points"]["console_scripts"]
    assert len(points) == 5
    for point in points:
        name, _, place = point.partition(" = ")
        assert place == f"{programs.__name__}:{name}"
        assert callable(getattr(programs, name))


@pytest.fixture
def programs(monkeypatch: pytest.MonkeyPatch, rclpy_nodes: list[Node]) -> Iterator[ModuleType]:
    monkeypatch.syspath_prepend(PACKAGE)
    yield import_module("sleec_ros.programs")
    for name in ("sleec_ros", "sleec_ros.programs"):
        sys.modules.pop(name, None)


@pytest.fixture
def run(programs: ModuleType, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Runs a program in this thread until `condition` holds. Arguments of ROS follow those of the program."""

    def run(name: str, argument: str, condition: Callable[[], object]) -> None:
        held: list[bool] = []
        main, before = threading.main_thread().ident, len(Node.made)
        assert main is not None

        def watch() -> None:
            # When it makes its node, the program is ready for the signal.
            held.append(eventually(lambda: len(Node.made) > before) and eventually(condition))
            # A program that has failed has put the handler back.
            if callable(signal.getsignal(signal.SIGTERM)):
                signal.pthread_kill(main, signal.SIGTERM)

        monkeypatch.setattr(sys, "argv", [name, argument, "--ros-args", "-r", "__ns:=/robot"])
        watching = threading.Thread(target=watch)
        watching.start()
        with pytest.raises(SystemExit) as ended:
            getattr(programs, name)()
        watching.join()
        assert ended.value.code == 0
        assert held == [True]
        assert Node.made[-1].context.args == ["--ros-args", "-r", "__ns:=/robot"]

    return run


def test_the_programs_run_their_nodes(run: Callable[..., None], tmp_path: Path) -> None:
    updates: list[object] = []
    outside = RclpyTransport("outside", [])
    outside.subscribe(LayersUpdate.topic, updates.append)
    run("context_manager", RULES, lambda: updates)
    refused: list[Executed] = []
    mission = MissionManagerNode(outside, on_executed=refused.append)

    def trigger() -> object:
        if Node.topics["/mission"] and not refused:
            mission.start("HumanOnFloor")
        return refused

    run("task_manager", "examples.robot.tasks:Safety", trigger)
    assert str(refused[0].refused).startswith("no Context Manager is known yet")
    mission.close()
    log = tmp_path / "log.jsonl"

    def publish() -> object:
        if Node.topics["/domain"]:
            outside.publisher(Topic("/domain")).publish({"data": '{"domain": null}'})
        return log.exists() and log.stat().st_size

    run("recorder", str(log), publish)
    assert '"topic": "/domain"' in log.read_text(encoding="utf-8")
    events: list[object] = []
    outside.subscribe(Topic("/mission"), events.append)
    run("mission_manager", f"{__name__}:guide", lambda: events)
    run("monitor", RULES, lambda: Node.topics["/executed"])
    outside.close()


def guide(node: MissionManagerNode) -> None:
    """The code of a mission."""
    node.start("MonitorMealTime")


def test_the_launch_file_starts_programs_of_the_package(setup: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    def launch_argument(name: str, *, description: str) -> tuple[str, str]:
        return ("argument", name)

    def node(*, package: str, executable: str, arguments: list[object], output: str) -> SimpleNamespace:
        return SimpleNamespace(package=package, executable=executable, arguments=arguments)

    fakes: dict[str, dict[str, object]] = {
        "launch": {"LaunchDescription": list},
        "launch.actions": {"DeclareLaunchArgument": launch_argument},
        "launch.substitutions": {"LaunchConfiguration": lambda name: ("argument", name)},
        "launch_ros": {},
        "launch_ros.actions": {"Node": node},
    }
    for name, members in fakes.items():
        module = ModuleType(name)
        vars(module).update(members)
        monkeypatch.setitem(sys.modules, name, module)
    entities = runpy.run_path(str(PACKAGE / "launch/sleec.launch.py"))["generate_launch_description"]()
    declared = {one for one in entities if isinstance(one, tuple)}
    nodes = [one for one in entities if not isinstance(one, tuple)]
    executables = {point.partition(" = ")[0] for point in setup["entry_points"]["console_scripts"]}
    assert {one.package for one in nodes} == {PACKAGE.name}
    assert {one.executable for one in nodes} == {"context_manager", "task_manager", "recorder"}
    assert {one.executable for one in nodes} <= executables
    assert {part for one in nodes for part in one.arguments if isinstance(part, tuple)} == declared
