"""Checks of the arguments of `Sleec`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError, WrongType
from sleec_runtime.model import Reading, Ruleset
from sleec_runtime.support.messages import represent

if TYPE_CHECKING:
    from pathlib import Path

    from sleec_runtime.certificate.requirement import CertificateRequirement
    from sleec_runtime.timed.clock import Clock, Time


def ruleset(given: Ruleset, reading: Reading | None) -> Ruleset:
    """The ruleset, with the reading if one is given. Raises WrongType."""
    if not isinstance(given, Ruleset):
        hint = "read one: sleec_runtime.language.parse(text), or sleec_runtime.load(path) for a file"
        raise WrongType("the ruleset", given, "a Ruleset", hint)
    return given if reading is None else given.read_as(reading)


def check_choices(**choices: object) -> None:
    """Raises WrongType for a value that is not True or False."""
    for name, choice in choices.items():
        if not isinstance(choice, bool):
            raise WrongType(name, choice, "a bool", "give True or False")


def demand(
    certificate: str | Path | None,
    chains: bool,
    key: str | Path | None = None,
    require_proved: bool = False,
    require_tied: bool = False,
) -> CertificateRequirement | None:
    """The requirements on the certificate, if there is one.

    Raises SleecError for requirements without a certificate, and as `CertificateRequirement`.
    """
    if certificate is None:
        asked = {"key": key is not None, "require_proved": require_proved, "require_tied": require_tied}
        if any(asked.values()):
            name = next(name for name, given in asked.items() if given)
            raise SleecError(f"{name} without a certificate checks nothing", "give certificate= as well")
        return None
    from sleec_runtime.certificate.manifest import Required
    from sleec_runtime.certificate.requirement import CertificateRequirement

    return CertificateRequirement(certificate, key, chains, Required(require_proved, require_tied))


def check_clock(clock: Clock | None) -> None:
    """Raises WrongType for an object that is not a clock."""
    if clock is not None:
        from sleec_runtime.timed.clock import check_clock as check

        check(clock)


def world_time(now: Time | None) -> Time:
    """The time in seconds since 1970. Raises WrongType."""
    import time

    from sleec_runtime.timed.clock import checked_time

    return time.time() if now is None else checked_time(now, "now")


def triggers(names: Iterable[str]) -> tuple[str, ...]:
    """The names of triggers, each once. Raises WrongType."""
    hint = f"give a list: [{represent(names)}]" if isinstance(names, str) else 'give a list: ["A", "B"]'
    if not isinstance(names, str):
        try:
            return tuple(dict.fromkeys(names))
        except TypeError:
            pass
    raise WrongType("the argument of trigger_all", names, "a list of names of triggers", hint)
