"""The command reference, from the commands themselves."""

from __future__ import annotations

import re
from collections.abc import Iterator
from inspect import cleandoc

import click

from sleec_verify.cli.commands import sleec_verify

FOLDER = "commands"

_TO_BE_CODE = re.compile(r"(?<![\w-])(--?[a-z][\w-]*|-(?= for standard)|\*\.[\w.]+)")


def commands() -> dict[str, click.Command]:
    """Every command by its name, in the order of `sleec-verify --help`."""
    context = click.Context(sleec_verify)
    found = {name: sleec_verify.get_command(context, name) for name in sleec_verify.list_commands(context)}
    return {name: command for name, command in found.items() if command is not None}


def pages() -> dict[str, str]:
    """The pages by their paths in the site."""
    known = commands()
    return {f"{FOLDER}/index.md": _index(known), **{f"{FOLDER}/{name}.md": _page(known[name]) for name in known}}


def _index(known: dict[str, click.Command]) -> str:
    rows = "".join(
        f"| [`{name}`]({name}.md) | {command.get_short_help_str(200)} |\n" for name, command in known.items()
    )
    table = f"| command | what it does |\n| --- | --- |\n{rows}"
    return f"# Commands\n\n{_text(sleec_verify)}\n\n{table}\n{_options(sleec_verify)}"


def _page(command: click.Command) -> str:
    context = _context(command)
    usage = " ".join(command.collect_usage_pieces(context))
    return (
        f"---\ntitle: {command.name}\n---\n\n# sleec-verify {command.name}\n\n{command.get_short_help_str(200)}\n\n"
        f"```text\nsleec-verify {command.name} {usage}\n```\n\n{_text(command)}\n\n"
        f"## Example\n\n```console\n$ {example(command)}\n```\n\n## Options\n\n{_options(command)}"
    )


def example(command: click.Command) -> str:
    """The command line that the help shows."""
    return (command.epilog or "").removeprefix("Example: ")


def _context(command: click.Command) -> click.Context:
    return click.Context(command, info_name=command.name, help_option_names=["-h", "--help"])


def _text(command: click.Command) -> str:
    """The paragraphs of the help text. Options, files and patterns become code, lists stay lists."""
    paragraphs = cleandoc(command.help or "").split("\n\n")
    # Click keeps the lines of a paragraph that starts with a backspace.
    return "\n\n".join(
        _code(paragraph.replace("\b\n", "") if paragraph.startswith("\b") else " ".join(paragraph.split()))
        for paragraph in paragraphs
    )


def _options(command: click.Command) -> str:
    # In code, | divides no cells; elsewhere it would.
    records = ((option, _code(meaning).replace("|", "&#124;")) for option, meaning in _records(command))
    rows = "".join(f"| `{option}` | {meaning} |\n" for option, meaning in records)
    return f"| option | meaning |\n| --- | --- |\n{rows}"


def _records(command: click.Command) -> Iterator[tuple[str, str]]:
    context = _context(command)
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context) if isinstance(parameter, click.Option) else None
        if record is not None:
            yield record


def _code(text: str) -> str:
    """Options, patterns of names and the - of standard input as code, where they are not yet."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if part.startswith("`") else _TO_BE_CODE.sub(r"`\g<0>`", part) for part in parts)
