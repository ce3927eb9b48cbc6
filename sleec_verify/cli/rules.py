"""``sleec-verify rules``."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import click

from sleec_verify.checks import CHECKS, Check, FindingKind
from sleec_verify.cli import exits, options
from sleec_verify.cli.output import write
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
    """List what `check` can find, or explain one CODE (or one check by its name): what it means, why it matters, a
    ruleset that has it and one that has not."""
    by_code = {kind.code: (check, kind) for check in CHECKS.values() for kind in check.kinds}
    chosen = by_code if code is None else _matching(by_code, code)
    palette = Palette.of(sys.stdout)
    if form == "json":
        from sleec_verify.report.json import dump

        write((dump([_json(check, kind) for check, kind in chosen.values()]),))
    elif code is None:
        write(_listed(by_code, palette))
    else:
        for check, kind in chosen.values():
            write(_explained(check, kind, palette))
    return exits.HOLDS


_ByCode = Mapping[str, tuple[Check, FindingKind]]


def _matching(by_code: _ByCode, code: str) -> _ByCode:
    wanted = {c: pair for c, pair in by_code.items() if code.upper() == c or code == pair[0].name}
    if not wanted:
        from sleec_runtime.language.suggest import nearest

        near = nearest(code.upper(), by_code) or nearest(code, CHECKS)
        hint = f"did you mean {near}?" if near else "`sleec-verify rules` lists them"
        raise click.UsageError(f"there is no finding code {code}; {hint}")
    return wanted


def _listed(by_code: _ByCode, palette: Palette) -> Iterator[str]:
    width = max(len(check.name) for check, _ in by_code.values())
    for code, (check, kind) in sorted(by_code.items()):
        yield f"{palette('strong', code)}  {palette(kind.severity, f'{kind.severity:7}')}  "
        yield f"{check.name:{width}}  {kind.title}\n"


def _explained(check: Check, kind: FindingKind, palette: Palette) -> Iterator[str]:
    from textwrap import fill, indent

    yield f"{palette('strong', kind.code)}: {kind.title}\n"
    yield f"{palette(kind.severity, kind.severity)} of the check {check.name}: {check.question}\n\n"
    yield fill(kind.explanation, 100) + "\n\n"
    for title, example in (("Rules that have it:", kind.bad), ("Rules that have not:", kind.good)):
        yield f"{title}\n\n{indent(example.strip(), '    ')}\n\n"


def _json(check: Check, kind: FindingKind) -> Json:
    return {
        "code": kind.code,
        "check": check.name,
        "severity": kind.severity,
        "title": kind.title,
        "question": check.question,
        "explanation": kind.explanation,
        "bad": kind.bad,
        "good": kind.good,
    }
