"""``sleec-verify rules``."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import click

from sleec_verify.audit.kinds import NAME
from sleec_verify.checks import CHECKS
from sleec_verify.cli import exits, options
from sleec_verify.cli.output import write
from sleec_verify.conformance import structure
from sleec_verify.report.catalogue import Entry, by_code
from sleec_verify.report.escape import as_text
from sleec_verify.report.palette import Palette

if TYPE_CHECKING:
    from sleec_verify.results.json_values import Json


def _completed(context: click.Context, parameter: click.Parameter, incomplete: str) -> list[str]:
    """The codes and checks that begin with `incomplete`, for shell completion."""
    kinds = by_code()
    names = dict.fromkeys([*kinds, *(entry.check for entry in kinds.values())])
    return [name for name in names if name.startswith((incomplete, incomplete.upper()))]


@click.command(
    "rules",
    short_help="List and explain every finding code.",
    epilog="Example: sleec-verify rules SLEEC101",
)
@click.argument("code", required=False, shell_complete=_completed)
@options.output_format("full", "json")
def command(code: str | None, form: str) -> int:
    """List all findings of `check`, `conform` and `audit`, or explain one finding CODE or one check: what it means, why
    it matters, how to fix it, and an example with the problem and one without."""
    kinds = by_code()
    chosen = kinds if code is None else _matching(kinds, code)
    palette = Palette.of(sys.stdout)
    if form == "json":
        from sleec_verify.results.json_values import dump

        write((dump([_json(entry) for entry in chosen.values()]),))
    elif code is None:
        write(_listed(kinds, palette))
    else:
        for number, entry in enumerate(chosen.values()):
            write((("\n" if number else ""), *_explained(entry, palette)))
    return exits.HOLDS


_ByCode = Mapping[str, Entry]


def _matching(kinds: _ByCode, code: str) -> _ByCode:
    wanted = {c: entry for c, entry in kinds.items() if code.upper() == c or code == entry.check}
    if not wanted:
        from sleec_verify.wording.phrases import quoted, shortened

        near = _near(kinds, code)
        hint = f"did you mean {near}?" if near else "`sleec-verify rules` lists all codes"
        raise click.UsageError(f"no finding code or check is called {quoted(shortened(code))}; {hint}")
    return wanted


def _near(kinds: _ByCode, code: str) -> str | None:
    """The code or check that is nearest to `code`. Codes of another hundred are near only if one letter differs."""
    from sleec_runtime.support.suggestions import edit_distance, nearest

    written = code.upper()
    same = [c for c in kinds if c[:-2] == written[:-2]]
    slips = (c for c in kinds if abs(len(c) - len(written)) < 2 and edit_distance(written, c, 2) < 2)
    return nearest(written, same) or next(slips, None) or nearest(code, [*CHECKS, structure.NAME, NAME])


@as_text
def _listed(kinds: _ByCode, palette: Palette) -> Iterator[str]:
    width = max(len(entry.check) for entry in kinds.values())
    for code, (check, _, kind, _) in kinds.items():
        severity = palette(kind.severity, f"{kind.severity:7}")
        yield f"{palette('strong', code)}  {severity}  {check:{width}}  {kind.title}"


@as_text
def _explained(entry: Entry, palette: Palette) -> Iterator[str]:
    from textwrap import indent, wrap

    check, question, kind, what = entry
    yield f"{palette('strong', kind.code)}: {kind.title}"
    yield f"{palette(kind.severity, kind.severity)} of the check {check}: {question}"
    yield from ("", *wrap(kind.explanation, 100))
    yield from ("", *wrap(f"How to fix it: {kind.mend}", 100))
    for title, example in ((f"{what} with the problem:", kind.bad), (f"{what}, fixed:", kind.good)):
        yield from ("", title, "", *indent(example.strip(), "    ").split("\n"))


def _json(entry: Entry) -> Json:
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
