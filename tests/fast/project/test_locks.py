"""The locks: exact versions with hashes, of everything that is asked for, the same versions in each."""

from __future__ import annotations

import re
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.support.paths import ROOT
from tests.support.pyprojects import RUNTIME, VERIFY

LOCKS = sorted(path.stem for path in (ROOT / "requirements").glob("*.lock"))


NEEDED = [
    *RUNTIME["project"]["dependencies"],
    *VERIFY["tool"]["hatch"]["metadata"]["hooks"]["custom"]["dependencies"],
]
EXTRAS = [
    requirement
    for project in (VERIFY, RUNTIME)
    for extra in project["project"]["optional-dependencies"].values()
    for requirement in extra
]
GROUPS: dict[str, list[Any]] = VERIFY["dependency-groups"]
ASKED = {
    "browser": GROUPS["browser"],
    "build": [*GROUPS["build"], *VERIFY["build-system"]["requires"], *RUNTIME["build-system"]["requires"]],
    "dev": [*NEEDED, *EXTRAS, *GROUPS["build"], *GROUPS["dev"]],
    "docs": GROUPS["docs"],
    "evaluation": GROUPS["evaluation"],
    "fuzz": GROUPS["fuzz"],
    "runtime": RUNTIME["project"]["dependencies"],
    "tools": GROUPS["tools"],
    "verify": NEEDED,
}


def lines(lock: str) -> list[str]:
    """A line for each package."""
    text = (ROOT / "requirements" / f"{lock}.lock").read_text(encoding="utf-8")
    return [line for line in text.replace("\\\n", " ").splitlines() if re.match(r"[^\s#]", line)]


def locked(lock: str) -> dict[str, Requirement]:
    """What a lock pins on this Python, by name."""
    pinned = (Requirement(line.split("--hash")[0]) for line in lines(lock))
    return {canonicalize_name(one.name): one for one in pinned if applies(one)}


def applies(requirement: Requirement) -> bool:
    """Whether a requirement counts on this Python."""
    return requirement.marker is None or requirement.marker.evaluate()


def test_there_is_a_lock_for_each_installation() -> None:
    assert set(LOCKS) == set(ASKED)


@pytest.mark.parametrize("lock", LOCKS)
def test_a_lock_pins_every_package_to_one_version_with_hashes(lock: str) -> None:
    assert lines(lock)
    for line in lines(lock):
        assert re.fullmatch(r"[\w.-]+(\[[\w,-]+\])?==[\w.]+ (; [^;\\]+?)?( +--hash=sha256:[0-9a-f]{64})+", line), line
    names = [re.split(r"[=\[]", line)[0] for line in lines(lock)]
    # mutmut needs a package that Python 3.13 forks, and atheris has versions for some Pythons each.
    assert len(names) == len(set(names)) or lock in ("tools", "fuzz")


@pytest.mark.parametrize("lock", LOCKS)
def test_a_lock_holds_what_is_asked_for(lock: str) -> None:
    pinned = locked(lock)
    for asked in (Requirement(text) for text in ASKED[lock] if isinstance(text, str)):
        if asked.name != "sleec-runtime" and applies(asked):
            (version,) = pinned[canonicalize_name(asked.name)].specifier
            assert asked.specifier.contains(version.version, prereleases=True), asked


def test_the_locks_agree() -> None:
    """They are installed into one environment."""
    dev = locked("dev")
    for lock in LOCKS:
        for name, requirement in locked(lock).items():
            if name in dev:
                assert requirement.specifier == dev[name].specifier


def test_our_own_distributions_are_in_no_lock() -> None:
    """They are installed from the repository: an index may know others of these names."""
    for lock in LOCKS:
        assert not {"sleec-runtime", "sleec-verify"} & set(locked(lock))
