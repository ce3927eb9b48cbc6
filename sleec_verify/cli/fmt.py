"""``sleec-verify fmt``."""

from __future__ import annotations

import click

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import Ruleset
from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import files
from sleec_verify.cli.output import complain, note_link, tell, write_data, write_line
from sleec_verify.files.placement import write_whole
from sleec_verify.report.outcome import UnusableInput
from sleec_verify.results.internal_error import internal_errors_of
from sleec_verify.wording.phrases import counted


@click.command(
    "fmt",
    short_help="Format rules.",
    epilog="Example: sleec-verify fmt --check rulesets/",
)
@options.paths(several=True)
@click.option("--write", "mode", flag_value="write", help="Change the files in place.")
@click.option("--check", "mode", flag_value="check", help="Change nothing. Exit with 1 if --write would change a file.")
@click.option(
    "--diff", "mode", flag_value="diff", help="Change nothing. Show the changes of --write, and exit like --check."
)
@options.max_size
def command(paths: tuple[str, ...], mode: str | None) -> int:
    """Print the rules in the standard format. PATH is a file, a folder, or - for standard input.

    Comments and meaning are preserved. Files are changed only with --write.
    """
    found = list(files(paths, note_link))
    if mode is None and len(found) > 1:
        raise click.UsageError("several files need --write, --check or --diff")
    if mode == "write" and "-" in found:
        raise click.UsageError("standard input cannot be changed in place")
    changed = unusable = 0
    for path in found:
        try:
            if isinstance(path, UnusableInput):
                raise path.error
            with internal_errors_of(path):
                ruleset = load(path)
                laid_out = _laid_out(ruleset)
                changes = laid_out != ruleset.source.text
                if changes and mode == "write":
                    _replace(path, ruleset, laid_out)
        except SleecError as error:
            complain(error)
            unusable += 1
            continue
        if mode is None:
            write_data((laid_out,))
        elif changes:
            changed += 1
            _show(path, ruleset, laid_out, mode)
    if mode is not None:
        done = "changed" if mode == "write" else "to change"
        parts = [f"{each} {word}" for each, word in ((changed, done), (unusable, "unusable")) if each]
        number = counted(len(found), "file")
        tell(", ".join([number, *parts]) if parts else f"{number} {'is' if len(found) == 1 else 'are'} formatted")
    if unusable:
        return exits.UNUSABLE
    return exits.FINDINGS if changed and mode != "write" else exits.HOLDS


def _replace(path: str, ruleset: Ruleset, laid_out: str) -> None:
    """Replace the file's text, after a last check that the rules say the same."""
    if parse(laid_out) != ruleset:
        raise AssertionError(f"the layout of {path} would change what its rules say")
    write_whole(path, laid_out.encode())


def _laid_out(ruleset: Ruleset) -> str:
    text = print_ruleset(ruleset)
    return text.replace("\n", "\r\n") if "\r\n" in ruleset.source.text else text


def _show(path: str, ruleset: Ruleset, laid_out: str, mode: str) -> None:
    if mode == "write":
        tell(f"formatted {path}")
    elif mode == "check":
        write_line(f"{ruleset.source.path} is not formatted")
    else:
        from sleec_verify.cli.text_diff import show_diff

        show_diff(ruleset.source.path, ruleset.source.text, laid_out)
