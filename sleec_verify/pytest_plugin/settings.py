"""The plugin's options and ini values."""

from __future__ import annotations

from pathlib import Path

import pytest

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load
from sleec_runtime.model import READINGS, Ruleset
from sleec_verify.conformance.subject import Factory
from sleec_verify.pytest_plugin.target import load_target
from sleec_verify.results.finding import SEVERITIES, Severity

_RULESET: pytest.StashKey[Ruleset] = pytest.StashKey()
_TARGET: pytest.StashKey[Factory] = pytest.StashKey()


class BadSetting(SleecError):
    """An invalid option or ini value."""


def text(config: pytest.Config, name: str) -> str | None:
    """An option, or else the ini value of the same name; None if neither is set."""
    value = config.getoption(name, default=None)
    return str(value) if value is not None else (str(config.getini(name)) or None)


def ruleset_path(config: pytest.Config) -> Path | None:
    """The file of ``--sleec-ruleset`` relative to the working folder, or of the ini value relative to the root
    folder."""
    option = config.getoption("sleec_ruleset", default=None)
    if option is not None:
        return config.invocation_params.dir / str(option)
    value = str(config.getini("sleec_ruleset"))
    return config.rootpath / value if value else None


def ruleset(config: pytest.Config) -> Ruleset | None:
    """The ruleset of ``--sleec-ruleset``, read once. Raises what `load` raises."""
    path = ruleset_path(config)
    if path is None:
        return None
    if _RULESET not in config.stash:
        config.stash[_RULESET] = reread(load(path), config)
    return config.stash[_RULESET]


def target(config: pytest.Config) -> Factory | None:
    """The factory of ``--sleec-target``, imported once. Raises TargetError."""
    named = text(config, "sleec_target")
    if named is None:
        return None
    if _TARGET not in config.stash:
        option = config.getoption("sleec_target", default=None)
        folder = config.invocation_params.dir if option is not None else config.rootpath
        config.stash[_TARGET] = load_target(named, folder)
    return config.stash[_TARGET]


def reread(found: Ruleset, config: pytest.Config) -> Ruleset:
    """`found` in the reading of the ini value ``sleec_reading``, if set."""
    reading = str(config.getini("sleec_reading"))
    if not reading:
        return found
    if reading not in READINGS:
        raise BadSetting(f"sleec_reading is {reading!r}", "it is cascade or priority")
    return found.read_as(reading)


def domain(config: pytest.Config, of: Ruleset) -> str | None:
    """The ini value ``sleec_domain``, for rulesets that have that domain."""
    value = str(config.getini("sleec_domain"))
    return value if value in of.domains else None


def fail_level(config: pytest.Config) -> Severity:
    """The ini value ``sleec_fail_level``."""
    value = str(config.getini("sleec_fail_level"))
    if value not in SEVERITIES:
        raise BadSetting(f"sleec_fail_level is {value!r}", f"it is one of {', '.join(SEVERITIES)}")
    return value
