"""What a robot loads when it imports the runtime."""

from __future__ import annotations

import subprocess
import sys

import pytest

import sleec_runtime


def modules_after(code: str) -> set[str]:
    command = [
        sys.executable,
        "-c",
        f"import sys; before = set(sys.modules); {code}; print(*(set(sys.modules) - before))",
    ]
    return set(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split())


def test_importing_the_package_loads_nothing_else() -> None:
    assert {name for name in modules_after("import sleec_runtime") if name.startswith("sleec")} == {"sleec_runtime"}


def test_a_running_robot_needs_contextpy3_and_the_standard_library() -> None:
    loaded = modules_after(
        "import sleec_runtime; s = sleec_runtime.load('rulesets/household.sleec'); s.activate_globally();"
        "sleec_runtime.Monitor(s, print); sleec_runtime.Sensors(s)"
    )
    top = {name.partition(".")[0] for name in loaded}
    assert top - set(sys.stdlib_module_names) <= {"sleec_runtime", "contextpy3"}
    assert "asyncio" not in top


def test_rulesets_without_times_load_nothing_that_keeps_them() -> None:
    code = "import sleec_runtime; s = sleec_runtime.load('rulesets/household.sleec'); s.due('CurtainOpenRequest')"
    loaded = modules_after(f"{code}; s.pending(); s.close()")
    assert not {name for name in loaded if name.startswith("sleec_runtime.timed")}


def test_rulesets_with_times_need_no_more_than_the_standard_library() -> None:
    rules = "RULE a WHEN A THEN X WITHIN 1 TO 2 seconds"
    loaded = modules_after(
        f"import sleec_runtime; from sleec_runtime.language import parse; s = sleec_runtime.Sleec(parse({rules!r}));"
        "s.implement({'X': print}); s.trigger('A'); s.close()"
    )
    top = {name.partition(".")[0] for name in loaded}
    assert top - set(sys.stdlib_module_names) <= {"sleec_runtime", "contextpy3"}
    assert not top & {"asyncio", "logging"}


def test_the_public_names() -> None:
    for name in sleec_runtime.__all__:
        assert getattr(sleec_runtime, name) is not None
        assert name in dir(sleec_runtime)
    with pytest.raises(AttributeError, match="no attribute 'lod'"):
        sleec_runtime.lod  # noqa: B018
