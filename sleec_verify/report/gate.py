"""The output of `gate`: for the terminal, as a Markdown summary for a pull request, and in every other format."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.support.messages import escaped
from sleec_verify.report.difference_phrases import (
    WORDS,
    change_in_words,
    conflict_in_words,
    extent_text,
    timed_conflict_in_words,
    witness_text,
)
from sleec_verify.report.escape import as_line, as_text
from sleec_verify.results.deduplication import deduplicate
from sleec_verify.wording.phrases import counted, error_summary, in_domains, in_short, listed

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_verify.changes.compare import Change, ConflictChange, DecidingClause, Difference
    from sleec_verify.changes.gate import Block, GateResult, RulesetExamination, Status
    from sleec_verify.report.palette import Palette

MARK = "<!-- written by sleec-verify gate -->"
"""The first line of every summary. `gate` overwrites only files that begin with it."""

MOST = 50
"""The most entries of a list in a summary."""

VERDICTS: Mapping[Status, str] = {
    "passed": "passed",
    "blocked": "blocked",
    "unknown": "inconclusive",
    "unusable": "invalid input",
}
_ROLES: Mapping[Status, str] = {"passed": "good", "blocked": "error", "unknown": "unknown", "unusable": "error"}


def render(found: GateResult, form: str, palette: Palette) -> Iterator[str]:
    """All results, in one of the formats of `check`."""
    if form == "full":
        yield from _full(found, palette)
    elif form == "json":
        from sleec_verify.report import gate_json

        yield from gate_json.render(found, palette)
    else:
        from sleec_verify.report import renderer
        from sleec_verify.report.gate_outcomes import outcomes

        yield from renderer(form)(outcomes(found), palette)
        if form in ("concise", "github"):
            yield f"{as_line(verdict(found, palette))}\n"


def verdict(found: GateResult, palette: Palette) -> str:
    """The summary line."""
    return f"{palette(_ROLES[found.status], VERDICTS[found.status])}: {_in_short(found)}"


# In full --------------------------------------------------------------------------------------------------


@as_text
def _full(found: GateResult, palette: Palette) -> Iterator[str]:
    from sleec_verify.report.difference_full import on_assertions, on_difference
    from sleec_verify.report.full import finding_lines

    for one in found.examined:
        if one.difference is not None:
            yield from on_difference(one.difference, palette)
            yield ""
        for finding in deduplicate(one.findings):
            assert one.ruleset is not None, "only what was read has findings"
            source = finding.source or one.ruleset.source
            yield from finding_lines(finding, source, palette)
            yield ""
        yield from _set_aside(one, palette)
    for conformed in found.conformed:
        for finding in conformed.findings:
            if finding.source is not None or conformed.ruleset is not None:
                source = finding.source or conformed.ruleset.source  # type: ignore[union-attr]
                yield from finding_lines(finding, source, palette)
                yield ""
    yield from on_assertions(found.asked, palette)
    yield from (f"{path}: {palette('error', 'unusable')}: {error_summary(error)}" for path, error in _errors(found))
    yield from (f"{palette('error', 'blocks')}: {_line(block)}" for block in found.blocks)
    yield from (f"{palette('unknown', 'unknown')}: {_line(block)}" for block in found.unknown)
    yield from (f"{palette('note', 'changes')}: {_line(block)}" for block in found.tolerated)
    if found.stale:
        word = "entry of the baseline is" if found.stale == 1 else "entries of the baseline are"
        yield f"{palette('note', 'note')}: {found.stale} {word} obsolete; update the baseline with --write-baseline"
    yield verdict(found, palette)


def _errors(found: GateResult) -> list[tuple[str, SleecError]]:
    """The errors, each with its path."""
    errors = [(one.path, error) for one in found.examined for error in one.errors]
    return [*errors, *((one.target.code, one.error) for one in found.conformed if one.error is not None)]


def _line(block: Block) -> str:
    return f"{block.policy}: {block.where}: {_what(block)}"


def _what(block: Block) -> str:
    return block.what if block.finding is None else f"{block.what}{in_domains(block.finding.domains)}"


def _set_aside(one: RulesetExamination, palette: Palette) -> Iterator[str]:
    for finding, suppression in one.allowed:
        message = f"{finding.message}{in_domains(finding.domains)}"
        what = f"{finding.code} {message} (reason: {suppression.reason})"
        yield f"{one.path}: {palette('faint', 'allowed')}: {what}"
    if one.known:
        yield f"{one.path}: {palette('faint', 'baseline')}: {counted(len(one.known), 'known finding')}"
    if one.certificate is not None and not isinstance(one.certificate, str):
        from sleec_verify.report.certificate import scope_text

        yield f"{one.path}: {palette('faint', 'certificate')}: valid ({scope_text(one.certificate.whole)})"
    for unused in one.unused:
        what = f"line {one.line(unused.span)} allows {unused.allowed}, but there is no such finding"
        yield f"{one.path}: {palette('warning', 'unused suppression')}: {what}"


def _in_short(found: GateResult) -> str:
    parts = [f"{counted(len(found.examined), 'ruleset')} examined, {found.unchanged} unchanged since {found.base}"]
    if found.blocks:
        parts.append(f"{counted(len(found.blocks), 'reason')} to block")
    if found.unknown:
        parts.append(f"{len(found.unknown)} inconclusive")
    if found.tolerated:
        parts.append(counted(len(found.tolerated), "policy change"))
    return "; ".join(parts)


# For a pull request ---------------------------------------------------------------------------------------


def markdown(found: GateResult) -> str:
    """The summary. Names and messages are escaped, so that they are not interpreted as Markdown or HTML."""
    return "\n".join(_markdown(found)) + "\n"


def _markdown(found: GateResult) -> Iterator[str]:
    yield MARK
    yield f"## SLEEC rules: {VERDICTS[found.status]}"
    yield ""
    yield f"Compared with {_code(found.base)}: {_plain(_in_short(found))}."
    lists = (
        ("Reasons to block", found.blocks),
        ("Inconclusive checks", found.unknown),
        ("Policy changes", found.tolerated),
    )
    for title, blocks in lists:
        if blocks:
            yield from ("", f"### {title}", "")
            lines = [f"- **{block.policy}**, {_code(block.where)}: {_plain(_what(block))}" for block in blocks]
            yield from _cut(lines, "reason")
    if found.unusable:
        yield from ("", "### Unreadable files", "")
        yield from (f"- {_code(path)}: {_plain(str(error).splitlines()[0])}" for path, error in _errors(found))
    if found.examined:
        yield from ("", "| ruleset | change | findings |", "| --- | --- | --- |")
        yield from _cut([_row(one) for one in found.examined], "ruleset", "| {} | | |")
    told = 0
    for one in found.examined:
        if one.difference is not None and (one.difference.changes or one.difference.conflict_ways):
            changes = list(_changes(one.difference))
            if told < MOST:
                yield from ("", f"### Changes in {_code(one.path)}", "")
                yield from _cut(changes, "change")
            told += len(changes)


def _cut(lines: Sequence[str], noun: str, last: str = "- {}") -> Iterator[str]:
    """At most `MOST` lines: services cut off or reject long summaries."""
    yield from lines[:MOST]
    if len(lines) > MOST:
        yield last.format(f"… and {counted(len(lines) - MOST, f'more {noun}')}: see the log")


def _row(one: RulesetExamination) -> str:
    change = "cannot be read"
    if one.difference is not None:
        change = f"{one.difference.relation}: {WORDS[one.difference.relation]}"
    counts = [counted(len(deduplicate(one.findings)), "finding")]
    counts += [f"{len(one.allowed)} allowed"] if one.allowed else []
    counts += [f"{len(one.known)} in the baseline"] if one.known else []
    counts += [f"{counted(len(one.unused), 'unused suppression')}"] if one.unused else []
    if one.coverage is not None:
        counts.append(f"{one.coverage} covered")
    moved = "" if one.was is None else f", was {_code(one.was)}"
    return f"| {_code(one.path)}{moved} | {_plain(change)} | {', '.join(counts)} |"


def _changes(difference: Difference) -> Iterator[str]:
    for change in difference.changes:
        yield _change(f"**{_plain(change_in_words(change))}**", change)
    for conflict in difference.conflicts:
        yield _change(f"**{_plain(conflict_in_words(conflict))}**", conflict)
    for timed in difference.timed_conflicts:
        yield f"- **{_plain(timed_conflict_in_words(timed))}**{_plain(in_domains(timed.domains))}"


def _change(head: str, one: Change | ConflictChange) -> str:
    lines = (
        f"- {head}, {_plain(extent_text(one.extent))}{_plain(in_domains(one.domains))}",
        f"  {_plain(witness_text(one.witness))}:",
        f"  before {_deciding(one.before)}; after {_deciding(one.after)}",
    )
    return "\n".join(lines)


def _deciding(deciding: tuple[DecidingClause, ...]) -> str:
    said = [f"{_plain(', '.join(map(in_short, one.obligations)) or 'nothing')} ({_code(one.rule)})" for one in deciding]
    return listed(said) if said else "nothing"


_SPECIAL = str.maketrans({character: f"\\{character}" for character in "\\`*_{}[]<>#|~"})


def _plain(text: str) -> str:
    return escaped(text).translate(_SPECIAL).replace("&", "&amp;").replace("@", "@\u200b")


def _code(text: str) -> str:
    """`text` as inline code. Characters that would end the code or a table cell are replaced."""
    cleaned = escaped(text).replace("`", "'").replace("|", "¦")
    return f"`{cleaned}`"
