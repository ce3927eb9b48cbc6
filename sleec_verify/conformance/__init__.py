"""Tests that the code executes what the rules oblige (docs/conformance-tests.md).

    from sleec_verify.conformance import conformance_test
    test_robot = conformance_test(make_sleec)

Only here and in the pytest plugin does `sleec_verify` run the runtime: as the subject of the test.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_verify.conformance import strategies as strategies
    from sleec_verify.conformance.failure import Nonconformance as Nonconformance
    from sleec_verify.conformance.machine import state_machine as state_machine
    from sleec_verify.conformance.subject import Bench as Bench
    from sleec_verify.conformance.subject import NotASubject as NotASubject
    from sleec_verify.conformance.subject import Subject as Subject
    from sleec_verify.conformance.suite import check_conformance as check_conformance
    from sleec_verify.conformance.suite import conformance_test as conformance_test

_HOMES = {
    "Bench": "subject",
    "Nonconformance": "failure",
    "NotASubject": "subject",
    "Subject": "subject",
    "check_conformance": "suite",
    "conformance_test": "suite",
    "state_machine": "machine",
}
__all__ = [*sorted(_HOMES), "strategies"]


def __getattr__(name: str) -> object:
    # The static check of this package needs neither Hypothesis nor the runtime.
    if name == "strategies":
        return import_module("sleec_verify.conformance.strategies")
    if name in _HOMES:
        return getattr(import_module(f"sleec_verify.conformance.{_HOMES[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
