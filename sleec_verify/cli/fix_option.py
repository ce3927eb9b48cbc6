"""The option ``--fix`` of `check`: with a repair as its value, or without one."""

from __future__ import annotations

import re
from collections.abc import Sequence

import click

_IDENTIFIER = re.compile(r"(SLEEC[0-9]{3}):([1-9][0-9]{0,5})", re.IGNORECASE)
_LIKE_A_VALUE = re.compile(r"SLEEC[0-9]*(:.*)?|\w+:[0-9]+", re.IGNORECASE)
"""Words after ``--fix`` that are not paths."""


class FixCommand(click.Command):
    """A command in which ``--fix`` takes a value only if the next word looks like one: a path may follow it."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        end = args.index("--") if "--" in args else len(args)
        options = args[:end]
        for number in range(end):
            if options[number] == "--fix" and not _LIKE_A_VALUE.fullmatch("".join(options[number + 1 : number + 2])):
                options[number] = "--fix="
        return super().parse_args(ctx, [*options, *args[end:]])


def identifiers(values: Sequence[str]) -> list[tuple[str, int]]:
    """The code and the number of each repair that the values of ``--fix`` name; an empty list for ``--fix`` alone.

    Raises:
        click.UsageError: a value names no repair, or ``--fix`` is there with and without a value.
    """
    found = []
    for value in filter(None, values):
        match = _IDENTIFIER.fullmatch(value)
        if match is None:
            raise click.UsageError(f"--fix {value}: write the code and the number of a repair, such as SLEEC101:1")
        found.append((match[1].upper(), int(match[2])))
    if found and not all(values):
        raise click.UsageError("--fix without a value cannot be combined with --fix CODE:N; run one after the other")
    return found
