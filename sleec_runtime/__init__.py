"""What a robot carries: reads SLEEC rules, decides which clause of each is active, and runs the right code.

``load`` gives a ruleset at work; see docs/runtime.md. Everything here is imported when it is first used.
"""

from __future__ import annotations

# As `typing` has it; importing that would take longer than the rest.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from pathlib import Path

    from sleec_runtime import errors as errors
    from sleec_runtime.errors import SleecError as SleecError
    from sleec_runtime.model import Reading
    from sleec_runtime.monitor import Monitor as Monitor
    from sleec_runtime.obligations import obligation as obligation
    from sleec_runtime.obligations import recording as recording
    from sleec_runtime.predicates import Sensors as Sensors
    from sleec_runtime.runtime import Sleec as Sleec

_HOMES = {
    "Monitor": "monitor",
    "Sensors": "predicates",
    "Sleec": "runtime",
    "SleecError": "errors",
    "obligation": "obligations",
    "recording": "obligations",
}
__all__ = ["Monitor", "Sensors", "Sleec", "SleecError", "errors", "load", "obligation", "recording"]


def load(path: str | Path, domain: str | None = None, reading: Reading | None = None, strict: bool = False) -> Sleec:
    """Reads the rules of a file and sets them to work.

    `domain` leaves out the rules of other domains. `reading`, ``cascade`` or ``priority``, goes before the file's own.
    `strict` makes a decision that depends on unreported conditions an error; without it they count as false, as
    Definition 1 of the paper has it. Raises UnreadableFile, LanguageError and UnknownDomain.
    """
    from sleec_runtime import language
    from sleec_runtime.runtime import Sleec

    return Sleec(language.load(path), domain, reading, strict)


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name == "errors":
        return import_module("sleec_runtime.errors")
    if name in _HOMES:
        return getattr(import_module(f"sleec_runtime.{_HOMES[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*globals(), *__all__]
