"""Runs of pytest with the plugin, in a folder of its own each time."""

from __future__ import annotations

from importlib.metadata import entry_points

import pytest

import sleec_verify.pytest_plugin
import sleec_verify.pytest_plugin.items
import sleec_verify.pytest_plugin.summary  # noqa: F401
from tests.support.plugin_texts import ROBOT, RULES

# Loaded here, because pytester unloads what is loaded within a run, and modules would exist twice in the next one.


@pytest.fixture
def run(pytester: pytest.Pytester):
    """Runs pytest on files, in this process, with the plugin."""
    loaded = any(point.value == "sleec_verify.pytest_plugin" for point in entry_points(group="pytest11"))

    def in_folder(*arguments: str, **files: str) -> pytest.RunResult:
        for name, text in {"house_sleec": RULES, "robot_py": ROBOT, **files}.items():
            path = pytester.path / name.replace("__", "/").replace("_cases_toml", ".cases.toml").replace("_", ".")
            path.write_text(text, encoding="utf-8")
        plugin = () if loaded else ("-p", "sleec_verify.pytest_plugin")
        return pytester.runpytest_inprocess(*plugin, "-p", "no:cacheprovider", *arguments)

    return in_folder
