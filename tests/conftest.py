"""Hypothesis profiles, chosen by HYPOTHESIS_PROFILE: `ci` (the default) repeats exactly, `long` searches on."""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, Phase, settings

# Fixtures of every folder.
from tests.support.action import runner as runner
from tests.support.checker import proved as proved
from tests.support.cli import cli as cli
from tests.support.resolve import answer as answer
from tests.support.theory_oracle import oracle as oracle

pytest_plugins = ["pytester"]
# Rulesets below tests are material for tests, bad ones among them; the pytest plugin is not to collect them.
collect_ignore_glob = ["*.sleec", "*.cases.toml"]

settings.register_profile(
    "ci", derandomize=True, deadline=None, print_blob=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("long", settings.get_profile("ci"), derandomize=False, max_examples=2000)
# A mutant that is found is found; the smallest example of it is of no use.
settings.register_profile("mutants", settings.get_profile("ci"), phases=[Phase.explicit, Phase.generate])
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))
# The cache of whoever runs the tests is no matter of theirs; those of the cache have folders of their own.
os.environ["SLEEC_VERIFY_CACHE"] = "off"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    # First what takes long, so that no process is left alone with it at the end.
    items.sort(key=lambda item: item.get_closest_marker("slow") is None)
