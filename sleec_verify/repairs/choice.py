"""Repairs that a user chooses by their identifiers, and what several of them do together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

from sleec_runtime.errors import SleecError
from sleec_verify.checks import CHECKS, Progress
from sleec_verify.repairs.edit import OverlappingEdits, in_order
from sleec_verify.repairs.numbering import NumberedRepair, ends_by_time, numbered_repairs
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.repairs.verification import Rejected
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import counted, listed
from sleec_verify.wording.sentence import joined

ONE_BY_ONE = "nothing was written; apply one of them, check again, and choose another"


class UnknownRepair(SleecError):
    """An identifier that names no repair of a ruleset."""


class IncompatibleRepairs(SleecError):
    """Repairs that cannot be applied together."""


def chosen_repairs(
    identifiers: Sequence[tuple[str, int]],
    findings: Sequence[Finding],
    search: RepairSearch,
    path: str,
    progress: Progress | None = None,
) -> list[NumberedRepair]:
    """The repairs with these codes and numbers, each once. `findings` are in the order of the report.

    Raises:
        UnknownRepair: there is no such repair, or a timeout makes the numbers uncertain.
    """
    wanted: dict[str, list[int]] = {}
    for code, number in dict.fromkeys(identifiers):
        wanted.setdefault(code, []).append(number)
    for code in wanted:
        if all(finding.code != code for finding in findings):
            raise _unknown_code(code, path)
    # Repairs have the numbers of a report only after the same search.
    found: dict[str, list[NumberedRepair]] = {code: [] for code in wanted}
    for one in numbered_repairs(findings, search, progress):
        code = one.finding.code
        if code not in found:
            continue
        found[code] += one.repairs
        if one.undecided is not None and ends_by_time():
            raise UnknownRepair(f"the repairs for {code} are not complete: {one.undecided}", "raise --timeout")
        if all(len(found[code]) >= max(numbers) for code, numbers in wanted.items()):
            break
    for code, numbers in wanted.items():
        for number in numbers:
            if number > len(found[code]):
                raise UnknownRepair(
                    f"there is no repair {code}:{number}: {path} has {counted(len(found[code]), 'repair')} for {code}",
                    "`sleec-verify check --fixes` lists the repairs",
                )
    return [found[code][number - 1] for code, number in dict.fromkeys(identifiers)]


def _unknown_code(code: str, path: str) -> UnknownRepair:
    codes = [kind.code for check in CHECKS.values() for kind in check.kinds]
    if code in codes:
        return UnknownRepair(
            f"{path} has no finding with the code {code}", "`sleec-verify check` lists the findings of the file"
        )
    return UnknownRepair(f"no finding has the code {code}", "`sleec-verify rules` lists the codes")


def combined(chosen: Sequence[NumberedRepair], search: RepairSearch) -> Repair:
    """The repairs that `search` has found as one. Several are verified together: each is only verified on its own.

    Costs a check for each of several repairs.

    Raises:
        IncompatibleRepairs: two of them repair the same finding or change the same part of the text; or together, they
            are not a repair, or change a meaning that each of them keeps.
    """
    first = chosen[0].repair
    if len(chosen) == 1:
        return first
    for one, other in combinations(chosen, 2):
        _require_apart(one, other)
    edits = tuple(in_order(edit for one in chosen for edit in one.repair.candidate.edits))
    title = joined("; ", (one.repair.candidate.title for one in chosen))
    joint = replace(first.candidate, title=title, edits=edits)
    together = f"together, {listed(one.identifier for one in chosen)}"
    try:
        verified = [search.verified(one.repair.finding, joint) for one in chosen]
    except Rejected as rejected:
        raise IncompatibleRepairs(f"{together} are not a repair: {rejected}", ONE_BY_ONE) from None
    if not verified[0].effect.keeps_meaning and all(one.repair.effect.keeps_meaning for one in chosen):
        raise IncompatibleRepairs(f"{together} change the meaning, which each of them keeps", ONE_BY_ONE)
    return verified[0]


def _require_apart(one: NumberedRepair, other: NumberedRepair) -> None:
    both = f"{one.identifier} and {other.identifier}"
    if one.repair.finding is other.repair.finding:
        raise IncompatibleRepairs(f"{both} repair the same finding", "nothing was written; choose one of them")
    try:
        in_order((*one.repair.candidate.edits, *other.repair.candidate.edits))
    except OverlappingEdits:
        raise IncompatibleRepairs(f"{both} change the same part of the text", ONE_BY_ONE) from None
