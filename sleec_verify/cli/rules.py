"""``sleec-verify rules``."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import click

from sleec_verify.checks import CHECKS, FindingKind
from sleec_verify.cli import exits, options
from sleec_verify.cli.output import write
from sleec_verify.conformance import structure
from sleec_verify.report.palette import Palette

if TYPE_CHECKING:
    from sleec_verify.report.json import Json


@click.command(
    "rules",
    short_help="List and explain every finding code.",
    epilog="Example: sleec-verify rules SLEEC101",
)
@click.argument("code", required=False)
@options.output_format("full", "json")
def command(code: str | None, form: str) -> int:
    """List what `check` and `conform` can find, or explain one CODE (or one check by its name): what it means, why it
    matters, how to mend it, an example that has it and one that has not."""
    by_code = _entries()
    chosen = by_code if code is None else _matching(by_code, code)
    palette = Palette.of(sys.stdout)
    if form == "json":
        from sleec_verify.report.json import dump

        write((dump([_json(entry) for entry in chosen.values()]),))
    elif code is None:
        write(_listed(by_code, palette))
    else:
        for entry in chosen.values():
            write(_explained(entry, palette))
    return exits.HOLDS


class _Entry(NamedTuple):
    """A kind of finding, the check that makes it, and what its examples are."""

    check: str
    question: str
    kind: FindingKind
    example: str


_ByCode = Mapping[str, _Entry]


def _entries() -> _ByCode:
    entries = [_Entry(check.name, check.question, kind, "Rules") for check in CHECKS.values() for kind in check.kinds]
    entries += [_Entry(structure.NAME, structure.QUESTION, k, "Rules and code") for k in structure.KINDS.values()]
    return {entry.kind.code: entry for entry in sorted(entries, key=lambda entry: entry.kind.code)}


def _matching(by_code: _ByCode, code: str) -> _ByCode:
    wanted = {c: entry for c, entry in by_code.items() if code.upper() == c or code == entry.check}
    if not wanted:
        from sleec_verify.report.words import shortened

        near = _near(by_code, code)
        hint = f"did you mean {near}?" if near else "`sleec-verify rules` lists all of them"
        raise click.UsageError(f"there is no finding code {shortened(code)}; {hint}")
    return wanted


def _near(by_code: _ByCode, code: str) -> str | None:
    """The code or check that was meant. Codes of another hundred are about something else, though a digit or two away:
    of these only a slip of one letter is near."""
    from sleec_runtime.language.suggest import edits, nearest

    written = code.upper()
    same = [c for c in by_code if c[:-2] == written[:-2]]
    slips = (c for c in by_code if abs(len(c) - len(written)) < 2 and edits(written, c, 2) < 2)
    return nearest(written, same) or next(slips, None) or nearest(code, [*CHECKS, structure.NAME])


def _listed(by_code: _ByCode, palette: Palette) -> Iterator[str]:
    width = max(len(entry.check) for entry in by_code.values())
    for code, (check, _, kind, _) in by_code.items():
        yield f"{palette('strong', code)}  {palette(kind.severity, f'{kind.severity:7}')}  "
        yield f"{check:{width}}  {kind.title}\n"


def _explained(entry: _Entry, palette: Palette) -> Iterator[str]:
    from textwrap import fill, indent

    check, question, kind, what = entry
    yield f"{palette('strong', kind.code)}: {kind.title}\n"
    yield f"{palette(kind.severity, kind.severity)} of the check {check}: {question}\n\n"
    yield fill(kind.explanation, 100) + "\n\n"
    yield fill(f"To mend it: {kind.mend}", 100) + "\n\n"
    for title, example in ((f"{what} that have it:", kind.bad), (f"{what} that have not:", kind.good)):
        yield f"{title}\n\n{indent(example.strip(), '    ')}\n\n"


def _json(entry: _Entry) -> Json:
    check, question, kind, _ = entry
    return {
        "code": kind.code,
        "check": check,
        "severity": kind.severity,
        "title": kind.title,
        "question": question,
        "explanation": kind.explanation,
        "mend": kind.mend,
        "bad": kind.bad,
        "good": kind.good,
    }
