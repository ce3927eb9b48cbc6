"""``sleec-verify check --fix``: apply repairs to files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import click

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_verify.cli import exits
from sleec_verify.cli.cached_checks import results as kept_or_new
from sleec_verify.cli.inputs import rulesets
from sleec_verify.cli.output import complain, tell
from sleec_verify.cli.progress import Progress
from sleec_verify.cli.text_diff import show_diff
from sleec_verify.repairs.choice import chosen_repairs, combined
from sleec_verify.repairs.hiding import hiding
from sleec_verify.repairs.numbering import numbered_repairs
from sleec_verify.repairs.rules_file import RulesFile
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.repairs.simplification import OFFERED, offered, simplifications
from sleec_verify.repairs.verification import is_read_otherwise
from sleec_verify.report.outcome import CheckedRuleset, UnusableInput
from sleec_verify.results.internal_error import internal_errors_of
from sleec_verify.wording.phrases import listed

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.cli.cache.store import Cache
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.repairs.repair import Repair


def apply(
    paths: Sequence[str],
    chosen: Sequence[tuple[str, int]],
    scope: Scope,
    cache: Cache | None,
    only_show: bool,
) -> int | None:
    """Apply the chosen repairs, or those that keep the meaning if none is chosen. With `only_show`, write the changes
    to standard output instead.

    Returns the exit code if the command ends with this; None if the files are to be checked again.

    Raises:
        click.UsageError: repairs are chosen for several files, standard input is to be changed, or without a choice,
            an option gives the rules a meaning that is not that of the whole file.
    """
    by_place: dict[str, Ruleset | UnusableInput] = {}
    for one in rulesets(paths, scope.reading, scope.domain):
        path = one.path if isinstance(one, UnusableInput) else one.source.path
        by_place.setdefault(os.path.realpath(path), one)  # a file may have several paths
    found = list(by_place.values())
    if chosen and len(found) > 1:
        raise click.UsageError("--fix CODE:N needs exactly one file")
    if "-" in paths and not only_show:
        raise click.UsageError("standard input cannot be changed in place; add --diff to show the change")
    errors = [one.error for one in found if isinstance(one, UnusableInput)]
    unreadable = [error for error in errors if isinstance(error, UnreadableFile)]
    if unreadable:
        for error in unreadable:
            complain(error)
        tell("nothing was written; a value of --fix is a code and a number, such as SLEEC101:1")
        return exits.UNUSABLE
    if not chosen:
        for ruleset in found:
            if not isinstance(ruleset, UnusableInput):
                _require_own_meaning(ruleset, scope)
    changed = failed = 0
    for ruleset in found:
        try:
            if isinstance(ruleset, UnusableInput):
                raise ruleset.error
            with internal_errors_of(ruleset.source.path):
                changed += _fix_one(ruleset, chosen, scope, cache, only_show)
        except SleecError as error:
            complain(error)
            failed += 1
    if failed:
        return exits.UNUSABLE
    return (exits.FINDINGS if changed else exits.HOLDS) if only_show else None


def _require_own_meaning(ruleset: Ruleset, scope: Scope) -> None:
    """Raise `UsageError` if the options give the rules another meaning than the whole text has on its own."""
    if scope.domain is not None and ruleset.domains:
        option = "--domain"
    elif is_read_otherwise(ruleset):
        option = "--reading"
    elif not scope.chains:
        option = "--no-chains"
    else:
        return
    raise click.UsageError(
        f"--fix without a value keeps the meaning of the whole file, so it cannot be combined with {option}; "
        "leave it out, or choose a repair with --fix CODE:N"
    )


def _fix_one(
    ruleset: Ruleset, chosen: Sequence[tuple[str, int]], scope: Scope, cache: Cache | None, only_show: bool
) -> bool:
    """Whether there was something to change."""
    path = ruleset.source.path
    with Progress() as progress:
        repairs = list(_repairs(ruleset, chosen, scope, cache, progress.on(path)))
        fixed = repairs[-1].repaired if repairs else ruleset
        left = [] if chosen else list(_left(fixed, scope, cache, progress.on(path)))
    if not repairs:
        tell(f"{path}: nothing to fix without a decision")
    if only_show and repairs:
        show_diff(path, ruleset.source.text, fixed.source.text)
    if only_show or not repairs:
        for line in left:
            tell(f"{path}: {line}")
        return bool(repairs)
    file = RulesFile.of(ruleset.source)
    for repair in repairs:
        file = file.edited(repair.candidate.edits)
    if file.text != repairs[-1].repaired.source.text:
        raise AssertionError(f"the change of {path} is not the one that was verified")
    file.write()
    for repair in repairs:
        tell(f"{path}: fixed: {repair.candidate.title}")
    for line in left:
        tell(f"{path}: {line}")
    return True


def _left(
    ruleset: Ruleset, scope: Scope, cache: Cache | None, progress: Callable[[str, int, int], None] | None
) -> Iterator[str]:
    """A line for each removal that a person decides on, with what hides an exception that never applies."""
    results = kept_or_new(ruleset, scope, cache, progress)
    findings = CheckedRuleset(ruleset, results).deduplicated
    if not any(one.code in OFFERED for one in findings):
        return
    searched = numbered_repairs(findings, RepairSearch(ruleset, results, scope), progress)
    of_code = (one for one in searched if one.finding.code in OFFERED)
    for finding, removal in offered(ruleset, results, of_code):
        names = hiding(ruleset, finding, scope)
        reason = f"{listed(names)} {'hides' if len(names) == 1 else 'hide'} it" if names else finding.note
        yield (
            f"not fixed: {finding.message}{f'; {reason}' if reason else ''}; "
            f"--fix {removal.identifier} would {removal.repair.candidate.title}"
        )


def _repairs(
    ruleset: Ruleset,
    chosen: Sequence[tuple[str, int]],
    scope: Scope,
    cache: Cache | None,
    progress: Callable[[str, int, int], None] | None,
) -> Iterator[Repair]:
    """The repairs, each of the text after the one before it."""
    results = kept_or_new(ruleset, scope, cache, progress)
    if not chosen:
        yield from simplifications(ruleset, results, scope)
        return
    findings = CheckedRuleset(ruleset, results).deduplicated
    search = RepairSearch(ruleset, results, scope)
    repairs = chosen_repairs(chosen, findings, search, ruleset.source.path, progress)
    yield combined(repairs, search)
