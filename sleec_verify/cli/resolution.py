"""The dialogue of ``sleec-verify resolve``: a person resolves the conflicts of a file, one by one."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from datetime import date
from io import TextIOWrapper
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.language import parse
from sleec_verify.cli.conflicts import Conflicts
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import complain, write_line
from sleec_verify.encoding.budget import limited
from sleec_verify.repairs.decision import comment_edit, decision
from sleec_verify.repairs.rules_file import FileChanged, RulesFile, require_writable
from sleec_verify.report.full import finding_lines
from sleec_verify.report.palette import Palette
from sleec_verify.report.repair_phrases import effect_in_words
from sleec_verify.wording.phrases import counted, quoted, shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.repairs.repair import Repair
    from sleec_verify.results.finding import Finding

SKIP, UNDO, QUIT = "skip", "undo", "quit"


class _Step(NamedTuple):
    """What `undo` restores: the list of skipped conflicts, and the file, if the step changed it."""

    skipped: frozenset[tuple[object, ...]]
    before: RulesFile | None


class Dialogue:
    """Shows the conflicts of the file at `path`, and applies the repairs that a person chooses."""

    def __init__(self, path: str, scope: Scope, timeout: float | None) -> None:
        self._path = path
        self._scope = scope
        self._timeout = timeout
        self._palette = Palette.of(sys.stdout)
        self._skipped: frozenset[tuple[object, ...]] = frozenset()
        self._steps: list[_Step] = []

    def run(self) -> int:
        """Ask until no conflict is left or the person quits, and return the exit code.

        Raises:
            SleecError: the file cannot be read or written. It is as it was after the last choice.
        """
        require_writable(self._path)
        if isinstance(sys.stdin, TextIOWrapper):
            sys.stdin.reconfigure(errors="replace")  # a terminal may send other bytes than UTF-8
        while True:
            with nullcontext() if self._timeout is None else limited(self._timeout):
                conflicts = Conflicts.of(self._load(), self._scope)
                waiting = [finding for finding in conflicts.findings if _identity(finding) not in self._skipped]
                self._show_state(conflicts, waiting)
                if not waiting and not self._steps:
                    break
                repairs = self._show(conflicts, waiting[0]) if waiting else []
            try:
                answer = self._ask(len(repairs), bool(waiting))
                if answer == QUIT:
                    break
                if answer == UNDO:
                    self._undo()
                elif answer == SKIP:
                    self._steps.append(_Step(self._skipped, None))
                    self._skipped |= {_identity(waiting[0])}
                else:
                    self._apply(conflicts.ruleset, repairs[int(answer) - 1])
            except EOFError:
                write_line("")  # ends the line of the question
                break
            except FileChanged as error:
                complain(error)
        return conflicts.exit_code

    def _load(self) -> Ruleset:
        return one_ruleset(self._path, self._scope.reading, self._scope.domain)

    def _show_state(self, conflicts: Conflicts, waiting: Sequence[Finding]) -> None:
        skipped = len(conflicts.findings) - len(waiting)
        number = counted(len(conflicts.findings), "conflict")
        write_line(f"{self._path}: {number}{f', {skipped} skipped' if skipped else ''}")
        if conflicts.undecided is not None:
            write_line(f"{self._path}: {self._palette('unknown', 'unknown[conflict]')} {conflicts.undecided}")

    def _show(self, conflicts: Conflicts, finding: Finding) -> list[Repair]:
        """Show a conflict and its repairs."""
        write_line("")
        for line in finding_lines(finding, conflicts.ruleset.source, self._palette):
            write_line(line)
        write_line("")
        write_line(self._palette("faint", "searching for repairs"))
        search = conflicts.search
        repairs = search.repairs(finding)
        if search.undecided is not None:
            write_line(f"{self._palette('unknown', 'unknown')} There may be more repairs: {search.undecided}")
        if not repairs:
            why = "" if search.reason is None else f": {search.reason}"
            write_line(f"No repair is found{why}. Skip this conflict, or change the rules by hand.")
        for number, repair in enumerate(repairs, 1):
            write_line(f"{self._palette('strong', f'{number:>3}')}  {repair.candidate.title}")
            write_line(f"     {self._palette('faint', effect_in_words(repair))}")
        return repairs

    def _ask(self, repairs: int, is_waiting: bool) -> str:
        """The answer of the person: the number of a repair, or a command. Raises `EOFError` at the end of input."""
        if not is_waiting:
            return UNDO if input("Press Enter to end, or type undo> ").strip().lower() in ("u", UNDO) else QUIT
        numbers = [str(number) for number in range(1, repairs + 1)]
        commands = [SKIP, *([UNDO] if self._steps else []), QUIT]
        offered = ", ".join([*(numbers if repairs < 2 else [f"1 to {repairs}"]), *commands])
        answers = {**{one: one for one in (*numbers, *commands)}, **{one[0]: one for one in commands}}
        while True:
            typed = input(f"Choose: {offered}> ").strip().lower()
            if typed in answers:
                return answers[typed]
            write_line(f"{f'{quoted(shortened(typed))} is not a choice; ' if typed else ''}type one of: {offered}")

    def _apply(self, ruleset: Ruleset, repair: Repair) -> None:
        reason = input("Why? A reason for reviewers, or Enter for none> ")
        record = decision(ruleset, repair, date.today(), reason)
        before = RulesFile.of(ruleset.source)
        after = before.edited(repair.candidate.edits).edited([comment_edit(ruleset, repair, record)])
        if parse(after.text).statements != repair.repaired.statements:
            raise AssertionError("the rules with the comment are not those that were verified")
        after = after.write()
        self._steps.append(_Step(self._skipped, replace(before, sha256=after.sha256)))
        write_line(f"{self._path}: fixed: {repair.candidate.title}")
        write_line(f"{self._path}: recorded: {record}")
        write_line("")

    def _undo(self) -> None:
        """Take back the last step. Raises `FileChanged` if somebody else has changed the file since then."""
        step = self._steps.pop()
        self._skipped = step.skipped
        if step.before is not None:
            step.before.write()
            write_line(f"{self._path}: the last choice is undone")


def _identity(finding: Finding) -> tuple[object, ...]:
    """A conflict, whatever its place."""
    return finding.code, finding.rules, finding.obligations
