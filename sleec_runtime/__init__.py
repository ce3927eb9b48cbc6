"""The runtime on a robot: it reads SLEEC rules, decides which clause of each rule is active, and runs its code.

`load` is the entry point; see docs/runtime.md. All names are imported when they are first used.
"""

from __future__ import annotations

# The version of both distributions.
__version__ = "0.1.0"

# As in `typing`, whose import would take longer than the rest.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from sleec_runtime import errors as errors
    from sleec_runtime.dispatch.implementations import obligation as obligation
    from sleec_runtime.dispatch.recording import recording as recording
    from sleec_runtime.errors import SleecError as SleecError
    from sleec_runtime.facade.sleec import Sleec as Sleec
    from sleec_runtime.model import Reading
    from sleec_runtime.monitor.monitor import Monitor as Monitor
    from sleec_runtime.predicates import Sensors as Sensors
    from sleec_runtime.timed.clock import Clock as Clock
    from sleec_runtime.timed.clocks import AsyncioClock as AsyncioClock
    from sleec_runtime.timed.clocks import PolledClock as PolledClock
    from sleec_runtime.timed.clocks import VirtualClock as VirtualClock
    from sleec_runtime.timed.failures import Failure as Failure
    from sleec_runtime.timed.monotonic_clock import MonotonicClock as MonotonicClock
    from sleec_runtime.timed.pending import Pending as Pending

_HOMES = {
    "AsyncioClock": "timed.clocks",
    "Clock": "timed.clock",
    "Failure": "timed.failures",
    "Monitor": "monitor.monitor",
    "MonotonicClock": "timed.monotonic_clock",
    "Pending": "timed.pending",
    "PolledClock": "timed.clocks",
    "Sensors": "predicates",
    "Sleec": "facade.sleec",
    "SleecError": "errors",
    "VirtualClock": "timed.clocks",
    "obligation": "dispatch.implementations",
    "recording": "dispatch.recording",
}
__all__ = [
    "AsyncioClock",
    "Clock",
    "Failure",
    "Monitor",
    "MonotonicClock",
    "Pending",
    "PolledClock",
    "Sensors",
    "Sleec",
    "SleecError",
    "VirtualClock",
    "errors",
    "load",
    "obligation",
    "recording",
]


def load(
    path: str | Path,
    domain: str | None = None,
    reading: Reading | None = None,
    strict: bool = False,
    *,
    clock: Clock | None = None,
    chains: bool = False,
    on_error: Callable[[Failure], object] | None = None,
    strict_times: bool = False,
    certificate: str | Path | None = None,
    key: str | Path | None = None,
    require_proved: bool = False,
    require_tied: bool = False,
) -> Sleec:
    """Reads the rules of a file, and puts them in force.

    `domain` leaves out the rules of other domains. `reading`, ``cascade`` or ``priority``, overrides that of the file.
    In `strict` mode, a decision that depends on unreported conditions raises an error; otherwise they are false
    (Definition 1 of the paper). `clock`, `chains`, `on_error` and `strict_times` are for rules with time: see `Sleec`.

    `certificate` is the folder of a certificate, which must prove these rules free of conflict in this reading and
    domain, with or without `chains`. With `key`, the file of a public key, it must be signed with it. With
    `require_proved` or `require_tied`, it must be made with `--require-proved` or `--require-tied`
    (docs/certificates.md).

    Raises UnreadableFile, LanguageError and UnknownDomain; UnsupportedTimes with `strict_times`; CertificateRefused
    with `certificate`.
    """
    from sleec_runtime import language
    from sleec_runtime.facade.sleec import Sleec

    return Sleec(
        language.load(path),
        domain,
        reading,
        strict,
        clock=clock,
        chains=chains,
        on_error=on_error,
        strict_times=strict_times,
        certificate=certificate,
        key=key,
        require_proved=require_proved,
        require_tied=require_tied,
    )


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name == "errors":
        return import_module("sleec_runtime.errors")
    if name in _HOMES:
        return getattr(import_module(f"sleec_runtime.{_HOMES[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*globals(), *__all__]
