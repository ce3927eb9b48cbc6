"""Nodes as processes: ``python -m sleec_runtime.ros context-manager | task | mission | record | monitor``.

A process ends with Ctrl-C or SIGTERM (see `main`). Arguments from ``--ros-args`` on are those of ROS.
"""

from __future__ import annotations

import argparse
import logging
import signal
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack, suppress
from importlib import import_module
from queue import SimpleQueue
from time import monotonic
from typing import Any, Protocol

from sleec_runtime import language
from sleec_runtime.audit.auditor import TOLERANCE, Auditor
from sleec_runtime.audit.mapping_file import NO_MAPPING, read_mapping
from sleec_runtime.errors import SleecError
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.ros.context_manager.context_manager_node import ContextManagerNode
from sleec_runtime.ros.mission_manager_node import MissionManagerNode
from sleec_runtime.ros.monitoring.live_topics import RECORDED, live_topics
from sleec_runtime.ros.monitoring.monitor_node import MonitorNode
from sleec_runtime.ros.monitoring.recorder_node import RecorderNode
from sleec_runtime.ros.transport import Transport
from sleec_runtime.support.messages import represent

_LOG = logging.getLogger("sleec_runtime.ros")


class Closable(Protocol):
    """A node that has started."""

    def close(self) -> None: ...


Definitions = Mapping[str, str]
"""Definitions of message types, by type."""
Connect = Callable[..., Transport]
"""Makes the transport of the node, with definitions of message types."""
Start = Callable[[argparse.Namespace, Connect], Closable]
"""Starts a node with the options of the command line."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a node until a signal ends it. Another signal, more than a second later, does so also while code of the user
    does not return.

    Returns 0; 1 if a monitor has found a breach of the rules; 2 for an error; 130 after another signal.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    ros = given.index("--ros-args") if "--ros-args" in given else len(given)
    options = _parser().parse_args(given[:ros])
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    # Not an Event: the handler runs in this thread, and would wait for the lock with which this thread waits.
    ended: SimpleQueue[int] = SimpleQueue()
    times: list[float] = []

    def end(number: int, _: object) -> None:
        times.append(monotonic())
        # A terminal and a launcher may both pass on the same Ctrl-C.
        if times[-1] - times[0] > 1:
            raise KeyboardInterrupt
        ended.put(number)

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    with suppress(KeyboardInterrupt), ExitStack() as ends:
        for number, handler in before.items():
            ends.callback(signal.signal, number, handler)

        def connect(definitions: Definitions = NO_MAPPING.definitions) -> Transport:
            transport = _transport(options, given[ros:], definitions)
            ends.callback(transport.close)
            return transport

        try:
            node = options.start(options, connect)
        except SleecError as error:
            _LOG.error("error: %s", error)
            return 2
        _LOG.info("%s: ready", options.name)
        ended.get()
        node.close()
        return int(isinstance(node, MonitorNode) and node.has_found_breach)
    return 130


def _transport(options: argparse.Namespace, ros_arguments: Sequence[str], definitions: Definitions) -> Transport:
    settle = getattr(options, "settle", 0)
    if options.transport == "rclpy":
        if settle:
            raise SleecError("--settle needs DDS", "leave out --settle or --transport rclpy")
        from sleec_runtime.ros.rclpy_transport import RclpyTransport

        return RclpyTransport(options.name, ros_arguments)
    from sleec_runtime.ros.dds.transport import DdsTransport

    return DdsTransport(definitions=definitions, settle=settle)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m sleec_runtime.ros", description="Start a node.", allow_abbrev=False
    )
    nodes = parser.add_subparsers(metavar="NODE", required=True)

    def node(name: str, start: Start, text: str) -> argparse.ArgumentParser:
        one = nodes.add_parser(name, help=text, description=text, allow_abbrev=False)
        one.set_defaults(start=start)
        one.add_argument("--name", default=name.replace("-", "_"), help="the name of the node (default: %(default)s)")
        one.add_argument(
            "--transport", choices=("dds", "rclpy"), default="dds", help="rclpy needs a ROS 2 workspace (default: dds)"
        )
        return one

    manager = node("context-manager", _context_manager, "Keep the context of the robot.")
    manager.add_argument("rules", metavar="RULES", help="the file with the rules")
    manager.add_argument("--domain", help="the domain at the beginning (default: the rules of all domains)")
    manager.add_argument(
        "--strict", action="store_true", help="reject triggers that depend on values that nobody has reported"
    )
    manager.add_argument("--checkpoint", metavar="FILE", help="keep the context and the deadlines here for a restart")
    task = node("task", _task, "Execute the rules of a task.")
    task.add_argument("code", metavar="MODULE:CLASS", help="a subclass of TaskManagerNode; it gets the transport")
    mission = node("mission", _mission, "Guide the robot through a mission.")
    mission.add_argument("code", metavar="MODULE:FUNCTION", help="code that runs once; it gets a MissionManagerNode")
    record = node("record", _recorder, "Record messages as JSON lines, which `sleec-verify audit` reads.")
    record.add_argument("log", metavar="LOG", help="the file to write; it must not exist")
    record.add_argument("--append", action="store_true", help="continue LOG if it exists")
    record.add_argument("--rules", metavar="RULES", help="the file with the rules, for --mapping")
    record.add_argument("--mapping", metavar="FILE", help="a TOML file that maps topics to names of the rules")
    monitor = node("monitor", _monitor, "Watch a robot, and publish deviations from the rules on /deviations.")
    monitor.add_argument("rules", metavar="RULES", help="the file with the rules")
    monitor.add_argument("--mapping", metavar="FILE", help="a TOML file that maps topics to names of the rules")
    monitor.add_argument("--domain", help="the domain at the beginning (default: the rules of all domains)")
    monitor.add_argument("--from-start", action="store_true", help="the robot starts after the monitor")
    monitor.add_argument("--reading", choices=("cascade", "priority"), help="the reading of several exceptions")
    monitor.add_argument("--untimed", choices=("at", "eventually"), default="at", help="as in `sleec-verify audit`")
    monitor.add_argument("--no-chains", action="store_true", help="as in `sleec-verify audit`")
    monitor.add_argument(
        "--tolerance", type=float, metavar="SECONDS", help="an obligation may be executed this much later (default: 1)"
    )
    for observer in (record, monitor):
        observer.add_argument(
            "--settle",
            type=float,
            default=0,
            metavar="SECONDS",
            help="over DDS, hold each message for this time, and order messages by the time at which they were sent; "
            "for senders whose clocks agree, as on one computer (default: 0)",
        )
    return parser


def _context_manager(options: argparse.Namespace, connect: Connect) -> Closable:
    sleec = Sleec(language.load(options.rules), options.domain, strict=options.strict)
    return ContextManagerNode(sleec, connect(), name=options.name, checkpoint=options.checkpoint)


def _task(options: argparse.Namespace, connect: Connect) -> Closable:
    node: Closable = _code_of_user(options.code)(connect())
    if not callable(getattr(node, "close", None)):
        raise SleecError(f"{represent(options.code)} is not a node", "give a subclass of TaskManagerNode")
    return node


def _mission(options: argparse.Namespace, connect: Connect) -> Closable:
    run = _code_of_user(options.code)
    node = MissionManagerNode(connect(), name=options.name)

    def guide() -> None:
        try:
            run(node)
        except SleecError as error:
            _LOG.error("%s: the mission has ended: %s", options.name, error)

    threading.Thread(target=guide, daemon=True).start()
    return node


def _code_of_user(name: str) -> Callable[..., Any]:
    """What `MODULE:NAME` names, which takes one argument."""
    from inspect import signature

    module, _, attribute = name.partition(":")
    try:
        code: Callable[..., Any] = getattr(import_module(module), attribute)
    except (AttributeError, ImportError, TypeError, ValueError) as error:
        raise SleecError(
            f"{represent(name)} cannot be used: {error}", "give MODULE:NAME, and put the folder of MODULE in PYTHONPATH"
        ) from error
    try:
        signature(code).bind(None)
    except (TypeError, ValueError) as error:
        raise SleecError(
            f"{represent(name)} cannot be called with one argument: {error}",
            "a class for `task` takes the transport, and a function for `mission` takes the node",
        ) from error
    return code


def _recorder(options: argparse.Namespace, connect: Connect) -> Closable:
    if options.mapping is not None and options.rules is None:
        raise SleecError("--mapping needs --rules", "give the file with the rules")
    mapping = NO_MAPPING if options.mapping is None else read_mapping(options.mapping, language.load(options.rules))
    topics = live_topics(RECORDED, mapping)
    return RecorderNode(connect(mapping.definitions), options.log, topics, append=options.append, name=options.name)


def _monitor(options: argparse.Namespace, connect: Connect) -> Closable:
    ruleset = language.load(options.rules)
    ruleset = ruleset if options.reading is None else ruleset.read_as(options.reading)
    has_times = ruleset.syntax == "dsl" or ruleset.is_timed
    chains = has_times or not options.no_chains
    mapping = NO_MAPPING if options.mapping is None else read_mapping(options.mapping, ruleset, chains)
    auditor = Auditor(
        ruleset,
        domain=options.domain,
        tolerance=next(one for one in (options.tolerance, mapping.tolerance, TOLERANCE) if one is not None),
        untimed=options.untimed if has_times else "at",
        chains=chains,
    )
    return MonitorNode(auditor, connect(mapping.definitions), mapping, late=not options.from_start, name=options.name)
