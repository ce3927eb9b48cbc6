"""The options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from math import isnan, nan
from typing import Any, TypeVar, cast

import click

from sleec_runtime.support.files import DEFAULT_MAX_SIZE, size_limit
from sleec_verify.cli.sizes import size_in_bytes
from sleec_verify.encoding.scope import Scope
from sleec_verify.results.finding import SEVERITIES
from sleec_verify.wording.translation import LANGUAGES

_Command = TypeVar("_Command", bound=Callable[..., Any])


PATH = click.Path(readable=False)
"""A path without checks: the code that reads it reports errors."""


def paths(several: bool) -> Callable[[_Command], _Command]:
    """The argument for files with rules. The code that reads them reports errors."""
    if several:
        return click.argument("paths", metavar="PATH…", nargs=-1, required=True, type=PATH)
    return click.argument("path", metavar="FILE", type=PATH)


reading = click.option(
    "--reading",
    type=click.Choice(("cascade", "priority")),
    help="Read several exceptions this way, whatever the file says: cascade applies the last exception before "
    "the first false condition; priority applies the last exception whose condition is true.",
)
domain = click.option(
    "--domain", metavar="NAME", help="Use only the rules of this domain and the rules that apply everywhere."
)
untimed = click.option(
    "--untimed",
    type=click.Choice(("at", "eventually")),
    default="at",
    show_default=True,
    help="In rules with time, a response without a window is due at the instant of its trigger (at, as in "
    "LEGOS-SLEEC) or at any time from then on (eventually, as in SLEEC-TK).",
)
chains = click.option(
    "--no-chains",
    "chains",
    flag_value=False,
    type=bool,
    default=True,
    help="Responses trigger no rules, as in the paper. Ignored for the DSL and for rules with time.",
)


def scope(*options: Callable[[_Command], _Command]) -> Callable[[_Command], _Command]:
    """Some of the options `reading`, `domain`, `untimed` and `chains`, as one argument: `scope`."""

    def decorate(command: _Command) -> _Command:
        @wraps(command)
        def with_scope(**values: Any) -> Any:
            given = {name: values.pop(name) for name in Scope._fields if name in values}
            return command(scope=Scope(**given), **values)

        decorated: Any = with_scope
        for option in reversed(options):
            decorated = option(decorated)
        return cast("_Command", decorated)

    return decorate


when = click.option(
    "--when", metavar="TRIGGERS", multiple=True, help="The triggers that occur, separated by commas: --when Fall,Night"
)
given = click.option(
    "--given",
    metavar="FACTS",
    multiple=True,
    help="The conditions and measures, separated by commas: "
    '--given "UserAsleep, not Undressed, UserAge=15". Everything else is false.',
)


def _limit(context: click.Context, parameter: click.Parameter, written: str) -> None:
    del parameter
    try:
        size = size_in_bytes(written)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None
    # The root context is closed even if a later option is rejected.
    context.find_root().with_resource(size_limit(size))


class Seconds(click.FloatRange):
    """A time in seconds. It has an upper bound, which also rejects infinity."""

    name = "seconds"

    def __init__(self, most: float, min_open: bool = False) -> None:
        super().__init__(min=0, min_open=min_open, max=most)

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> float:
        try:
            seconds = float(value)
        except ValueError:
            seconds = nan
        if isnan(seconds):
            self.fail(f"{value!r} is not a number of seconds", parameter, context)
        return float(super().convert(seconds, parameter, context))


def _within(context: click.Context, parameter: click.Parameter, seconds: float | None) -> None:
    del parameter
    if seconds is not None:
        from sleec_verify.encoding.budget import limited

        context.find_root().with_resource(limited(seconds))


_TIMEOUT: dict[str, Any] = {
    "metavar": "SECONDS",
    # Up to about 30 years.
    "type": Seconds(10**9, min_open=True),
    "help": "Stop after this time; checks that are not finished are unknown. This limit replaces the default limit, "
    "a number of steps for each file, which is the same on every machine.",
}
timeout = click.option("--timeout", callback=_within, expose_value=False, **_TIMEOUT)
"""The limit of a whole command."""
timeout_of_each_run = click.option("--timeout", **_TIMEOUT)
"""The limit in seconds, for a command that runs more than once."""


def requirements(where: str) -> Callable[[_Command], _Command]:
    """``--require-proved`` and ``--require-tied``; `where` is the first words of their help."""

    def decorate(command: _Command) -> _Command:
        proved = "a checker that is proved correct in Coq accepts every refutation"
        tied = "every verdict from a refutation is proved in Coq for the rules themselves"
        for name, what in (("--require-tied", tied), ("--require-proved", proved)):
            command = click.option(name, is_flag=True, help=f"{where}Reject a certificate unless {what}.")(command)
        return command

    return decorate


max_size = click.option(
    "--max-size",
    metavar="SIZE",
    default=f"{DEFAULT_MAX_SIZE // 2**20}MiB",
    show_default=True,
    callback=_limit,
    expose_value=False,
    help="Reject larger files. Examples: 200kB, 16MiB, 1000000.",
)
fail_level = click.option(
    "--fail-level",
    type=click.Choice(SEVERITIES),
    default="error",
    show_default=True,
    help="Exit with 1 if there is a finding of at least this severity.",
)
output = click.option(
    "-o",
    "--output",
    metavar="FILE",
    type=PATH,
    help="Write to this file, atomically. An existing file is overwritten.",
)

no_cache = click.option("--no-cache", is_flag=True, help="Do not use or write the cache.")


language = click.option(
    "--language",
    type=click.Choice(LANGUAGES),
    default=LANGUAGES[0],
    show_default=True,
    envvar="SLEEC_VERIFY_LANGUAGE",
    show_envvar=True,
    help="The language of sentences for people. Output for programs is always English.",
)


def output_format(*names: str) -> Callable[[_Command], _Command]:
    """``--format``; the first name is the default."""
    return click.option(
        "--format", "form", type=click.Choice(names), default=names[0], show_default=True, help="Output format."
    )


def situation(command: _Command) -> _Command:
    """The file of rules, a situation, and how the rules are read: `path`, `when`, `given` and `scope`."""
    for option in (max_size, scope(domain, reading, untimed), given, when, paths(several=False)):
        command = option(command)
    return command
