"""The options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar, cast

import click

from sleec_runtime.support.files import DEFAULT_MAX_SIZE, size_limit
from sleec_verify.cli.scope import Scope
from sleec_verify.cli.sizes import size_in_bytes
from sleec_verify.results.finding import SEVERITIES

_Command = TypeVar("_Command", bound=Callable[..., Any])


PATH = click.Path(readable=False)
"""A path of which nothing is asked here: whether it can be read is told by what reads it."""


def paths(several: bool) -> Callable[[_Command], _Command]:
    """The argument for texts of rules. Whether they exist is told with the other errors of the input."""
    if several:
        return click.argument("paths", metavar="PATH…", nargs=-1, required=True, type=PATH)
    return click.argument("path", metavar="FILE", type=PATH)


reading = click.option(
    "--reading",
    type=click.Choice(("cascade", "priority")),
    help="Read chains of hedges this way, whatever the file says: cascade stops at the first false condition, "
    "priority takes the last true one.",
)
domain = click.option(
    "--domain", metavar="NAME", help="Only the rules of this domain, with those that apply everywhere."
)
untimed = click.option(
    "--untimed",
    type=click.Choice(("at", "eventually")),
    default="at",
    show_default=True,
    help="When a response without a window is due, in rules with time: at the moment of its trigger, as LEGOS-SLEEC "
    "has it, or at some time from then on, as SLEEC-TK has it.",
)
chains = click.option(
    "--no-chains",
    "chains",
    flag_value=False,
    type=bool,
    default=True,
    help="Let a response trigger no rule: the one-step reading of the paper. The DSL and files with time count chains "
    "all the same.",
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
    "--when", metavar="TRIGGERS", multiple=True, help="What occurs, separated by commas: --when Fall,Night"
)
given = click.option(
    "--given",
    metavar="FACTS",
    multiple=True,
    help='What is the case, separated by commas: --given "UserAsleep, not Undressed, UserAge=15". The rest is false.',
)


def _limit(context: click.Context, parameter: click.Parameter, written: str) -> None:
    del parameter
    try:
        size = size_in_bytes(written)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None
    # The root context is closed even where a later option is refused.
    context.find_root().with_resource(size_limit(size))


class _Seconds(click.FloatRange):
    """A time in seconds, up to about 30 years."""

    name = "seconds"

    def __init__(self) -> None:
        super().__init__(min=0, min_open=True, max=10**9)

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> float:
        seconds = float(super().convert(value, parameter, context))
        if seconds != seconds:  # not a number
            self.fail(f"{value} is not a number of seconds", parameter, context)
        return seconds


def _within(context: click.Context, parameter: click.Parameter, seconds: float | None) -> None:
    del parameter
    if seconds is not None:
        from sleec_verify.encoding.budget import limited

        context.find_root().with_resource(limited(seconds))


_TIMEOUT: dict[str, Any] = {
    "metavar": "SECONDS",
    "type": _Seconds(),
    "help": "Stop deciding after this time. What is undecided by then is unknown. Without it, each file has a budget "
    "of work, which ends at the same place on every machine.",
}
timeout = click.option("--timeout", callback=_within, expose_value=False, **_TIMEOUT)
"""For the whole run of a command."""
timeout_of_each_run = click.option("--timeout", **_TIMEOUT)
"""For a command that runs more than once; it gets the seconds."""


def requirements(where: str) -> Callable[[_Command], _Command]:
    """``--require-proved`` and ``--require-tied``, with a word on where they count."""

    def decorate(command: _Command) -> _Command:
        proved = "the checker that is proved in Coq judges every refutation"
        tied = "every verdict that rests on a refutation is proved of the rules themselves"
        for name, what in (("--require-tied", tied), ("--require-proved", proved)):
            command = click.option(name, is_flag=True, help=f"{where}Refuse a certificate unless {what}.")(command)
        return command

    return decorate


max_size = click.option(
    "--max-size",
    metavar="SIZE",
    default=f"{DEFAULT_MAX_SIZE // 2**20}MiB",
    show_default=True,
    callback=_limit,
    expose_value=False,
    help="Refuse to read a file that is larger than this, as in 200kB, 16MiB or 1000000.",
)
fail_level = click.option(
    "--fail-level",
    type=click.Choice(SEVERITIES),
    default="error",
    show_default=True,
    help="Exit with 1 if there is a finding as grave as this.",
)
output = click.option(
    "-o",
    "--output",
    metavar="FILE",
    type=PATH,
    help="Write to this file instead, whole or not at all. A file that is there is replaced.",
)

no_cache = click.option(
    "--no-cache", is_flag=True, help="Decide everything anew, and keep nothing of it for the next time."
)


def output_format(*names: str) -> Callable[[_Command], _Command]:
    """``--format``, of which the first name is the default."""
    return click.option(
        "--format", "form", type=click.Choice(names), default=names[0], show_default=True, help="How to say it."
    )


def situation(command: _Command) -> _Command:
    """The file of rules, a situation, and how the rules are read: `path`, `when`, `given` and `scope`."""
    for option in (max_size, scope(domain, reading, untimed), given, when, paths(several=False)):
        command = option(command)
    return command
