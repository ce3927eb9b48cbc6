"""Imports point one way: between modules, between rooms, and between the two distributions.

Imports within functions and under TYPE_CHECKING count.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter

import pytest

from tests.support.paths import ROOT

PACKAGES = ("sleec_runtime", "sleec_verify")
RUNTIME_LAYERS = (
    "support",
    "errors",
    "concurrency",
    "model",
    "language",
    "evaluation",
    "certificate",
    "dispatch",
    "monitor",
    "timed",
    "audit",
    "facade",
    "predicates",
    "ros",
)
"""The rooms of the runtime. Each imports only rooms before it."""
VERIFIER_LAYERS = (
    "files",
    "wording",
    "results",
    "audit",
    "encoding",
    "query",
    "traces",
    "games",
    "replay",
    "checks",
    "entailment",
    "exchange",
    "certificates",
    "conformance",
    "changes",
    "repairs",
    "decision_tables",
    "report",
    "pytest_plugin",
    "serve",
    "cli",
    "__main__",
)
"""The rooms of the verifier. Each imports only rooms before it."""
EVALUATOR = ("evaluation", "dispatch", "monitor", "timed", "audit", "facade", "ros")
"""The rooms of the runtime that evaluate rules directly."""
MEETINGS = ("replay", "conformance", "pytest_plugin")
"""The rooms of the verifier in which evaluator and solver meet: replays, and tests of robots. Elsewhere, a module
`replay` does."""
WITHOUT_SOLVER = "sleec_verify.audit"
"""A room of the verifier that uses the evaluator alone."""
SCENARIOS = "sleec_verify.conformance.scenarios"
"""The part of a test of robots that decides what scenarios require. It may run on a robot that runs the evaluator, so
it uses the solver alone."""
OF_THE_ROBOT = {
    f"{SCENARIOS}.player": {"sleec_runtime.dispatch.recording", "sleec_runtime.timed.clock"},
    f"{SCENARIOS}.clock": {"sleec_runtime.timed.clock"},
}
"""What sees the robot under test, and what gives it the time."""
SOLVER_LAYERS = VERIFIER_LAYERS[VERIFIER_LAYERS.index("encoding") : VERIFIER_LAYERS.index("report")]


@cache
def imports() -> dict[str, set[str]]:
    """Each module of both packages, with the modules of both packages that it imports."""
    paths = {}
    for package in PACKAGES:
        for path in (ROOT / package).rglob("*.py"):
            parts = path.relative_to(ROOT).with_suffix("").parts
            paths[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    found: dict[str, set[str]] = {module: set() for module in paths}
    for module, path in paths.items():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names: Iterable[str] = ()
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                assert not node.level, f"{module} has a relative import, which this test does not resolve"
                names = [f"{node.module}.{alias.name}" for alias in node.names]
            for name in names:
                while name and name not in paths:
                    name = name.rpartition(".")[0]
                if name and name != module:
                    found[module].add(name)
    return found


def room(module: str) -> str:
    """The package and folder of a module."""
    return ".".join(module.split(".")[:2])


def rooms() -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for module, imported in imports().items():
        found.setdefault(room(module), set()).update(room(one) for one in imported if room(one) != room(module))
    return found


@pytest.mark.parametrize("graph", [imports, rooms], ids=["modules", "rooms"])
def test_there_is_no_cycle(graph: Callable[[], Mapping[str, set[str]]]) -> None:
    try:
        tuple(TopologicalSorter(graph()).static_order())
    except CycleError as error:
        pytest.fail(" imports ".join(reversed(error.args[1])))


def test_the_runtime_does_not_import_the_verifier() -> None:
    for module, imported in imports().items():
        if module.startswith("sleec_runtime"):
            assert not [one for one in imported if one.startswith("sleec_verify")], module


@pytest.mark.parametrize(("package", "layers"), [("sleec_runtime", RUNTIME_LAYERS), ("sleec_verify", VERIFIER_LAYERS)])
def test_rooms_import_lower_rooms_only(package: str, layers: tuple[str, ...]) -> None:
    found = {one.partition(".")[2]: imported for one, imported in rooms().items() if one.startswith(f"{package}.")}
    assert found.keys() == set(layers)
    for number, layer in enumerate(layers):
        own = {one.partition(".")[2] for one in found[layer] if one.startswith(f"{package}.")}
        assert own <= set(layers[:number]), layer


def test_the_evaluator_and_the_solver_meet_only_in_replays_and_tests_of_robots() -> None:
    evaluator = tuple(f"sleec_runtime.{one}" for one in EVALUATOR)
    meetings = tuple(f"sleec_verify.{one}" for one in MEETINGS)
    for module, imported in imports().items():
        if module.startswith("sleec_verify") and not (module.startswith(meetings) or module.endswith(".replay")):
            if module.startswith(WITHOUT_SOLVER):
                assert not [one for one in imported if room(one).partition(".")[2] in SOLVER_LAYERS], module
            else:
                assert not [one for one in imported if one.startswith(evaluator)], module


def test_what_scenarios_require_is_decided_without_the_evaluator() -> None:
    evaluator = (*(f"sleec_runtime.{one}" for one in EVALUATOR), "sleec_verify.replay")
    found = {module for module in imports() if module.startswith(SCENARIOS)}
    assert len(found) > 10
    for module in found:
        others = imports()[module] - OF_THE_ROBOT.get(module, set())
        assert not [one for one in others if one.startswith(evaluator)], module
