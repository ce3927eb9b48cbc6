"""The errors that a user can cause. Each says what is wrong, where, and how to fix it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from sleec_runtime.support.messages import LONGEST, bounded, escaped, listed, represent
from sleec_runtime.support.spans import Source, Span
from sleec_runtime.support.suggestions import nearest


class SleecError(Exception):
    """The base of all errors that a user can cause.

    `message` says what is wrong. `hint` says how to fix it, or is None. Each has at most 2,000 characters; longer text
    is shortened.
    """

    def __init__(self, message: str, hint: str | None = None) -> None:
        self.message = bounded(message)
        self.hint = None if hint is None else bounded(hint)
        super().__init__(self.message)

    def __str__(self) -> str:
        """A line for each problem, up to 4,000 characters. Control characters and line breaks in names are escaped."""
        return bounded("\n".join(map(escaped, self.sentences())), 2 * LONGEST)

    def sentences(self) -> list[str]:
        """Each problem with its hint, not escaped."""
        return [f"{self.message} ({self.hint})" if self.hint else self.message]


@dataclass(frozen=True)
class Problem:
    """A problem in a text of rules, with its place and a hint."""

    message: str
    span: Span
    hint: str | None = None


class LanguageError(SleecError):
    """A text that is not a valid ruleset. `problems` are in text order."""

    def __init__(self, source: Source, problems: Sequence[Problem]) -> None:
        self.source = source
        self.problems = tuple(problems)
        super().__init__("\n".join(self.sentences()))

    def sentences(self) -> list[str]:
        lines = []
        for problem in self.problems:
            place = self.source.place(problem.span)
            hint = f" ({problem.hint})" if problem.hint else ""
            lines.append(f"{self.source.path}:{place.line}:{place.column}: {problem.message}{hint}")
        return lines


class Unsayable(SleecError):
    """A construct of a ruleset that a language cannot express."""


class UnreadableFile(SleecError):
    """A file that cannot be read: missing, forbidden, too large, not a regular file, or not UTF-8 text."""


class CertificateRefused(SleecError):
    """A certificate that is malformed, or does not cover the rules at hand. `problems` pairs each reason, one of those
    in docs/certificates.md, with a message."""

    def __init__(self, problems: Sequence[tuple[str, str]], hint: str | None = None) -> None:
        super().__init__("\n".join(message for _, message in problems), hint)
        self.problems = tuple(problems)

    def sentences(self) -> list[str]:
        messages = [message for _, message in self.problems]
        return [*messages[:-1], f"{messages[-1]} ({self.hint})" if self.hint else messages[-1]]


# Raised before anything is executed ----------------------------------------------------


class UnsupportedTimes(SleecError):
    """Rules with time or relations, given to a command or mode that does not support them. `lines` are the lines of
    the constructs."""

    def __init__(self, message: str, lines: Sequence[int], hint: str | None = None) -> None:
        super().__init__(
            message, hint or "leave them out, or use `sleec-verify check`, `entail` or `explain`, which support them"
        )
        self.lines = tuple(lines)


class UnsupportedCalculations(SleecError):
    """Rules that calculate with several measures, given to a command that does not support it. `lines` are the lines
    of the calculations, 0 for one that is not from a text."""

    def __init__(self, message: str, lines: Sequence[int]) -> None:
        super().__init__(
            message,
            "compare one measure with a number, or two measures; or use `sleec-verify check`, `entail` or `explain`, "
            "which support calculations",
        )
        self.lines = tuple(lines)


class WrongArguments(SleecError, TypeError):
    """Arguments of a trigger that do not fit the signature of the code of one of its rules."""


class WrongType(SleecError):
    """A value that does not fit its condition, measure or parameter. `name` is the name of the latter."""

    def __init__(self, name: str, value: object, expected: str, hint: str | None = None) -> None:
        super().__init__(f"{name} is {expected}; got {represent(value)}", hint)
        self.name = name


class UnknownName(SleecError, LookupError):
    """A name that the ruleset does not have. The hint suggests the nearest known name."""

    kind = "name"
    holder = "the ruleset"

    def __init__(self, name: str, known: Iterable[str], hint: str | None = None) -> None:
        if not isinstance(name, str):
            article = "an" if self.kind[0] in "aeiou" else "a"
            hint = f"give the name of {article} {self.kind}, a str"
        super().__init__(f"unknown {self.kind} {represent(name)}", hint or self._suggestion(name, sorted(known)))
        self.name = name

    def _suggestion(self, name: str, known: Sequence[str]) -> str:
        near = nearest(name, known)
        if near is not None:
            return f"did you mean `{near}`?"
        if not known:
            return f"{self.holder} has no {self.kind}"
        return f"{self.holder} has {listed(known)}"


class UnknownLabel(UnknownName):
    kind = "rule"


class UnknownLayer(UnknownName, KeyError):
    kind = "layer"


class UnknownTrigger(UnknownName):
    kind = "trigger"


class UnknownCondition(UnknownName):
    kind = "condition or measure"


class UnknownObligation(UnknownName):
    kind = "obligation"


class UnknownDomain(UnknownName):
    kind = "domain"


class NotBound(SleecError):
    """Rules without code: no method, or no variant for a clause with obligations. `rules` are their labels."""

    def __init__(self, message: str, rules: Sequence[str], hint: str | None = None) -> None:
        super().__init__(message, hint)
        self.rules = tuple(rules)


class AlreadyBound(SleecError):
    """A second method for a rule: the method manager MM maps each rule to one method (paper, Section 3.2)."""


class Unbindable(SleecError):
    """A callable that cannot be the method of a rule, for example because it is not marked."""


class UndeterminedDecision(SleecError):
    """A decision that depends on unreported conditions (in strict mode), or on an unreported measure that gives the
    length of a window (in any mode). `missing` are their names."""

    def __init__(self, triggers: Sequence[str], missing: Sequence[str], hint: str | None = None) -> None:
        super().__init__(
            f"the decision for {' and '.join(triggers)} depends on unreported values: {listed(missing)}",
            hint or "report them with update(), or load the ruleset without strict",
        )
        self.missing = tuple(missing)


class ConflictInContext(SleecError):
    """The obligations of this context contradict each other, so none is executed.

    `conflict` is the smallest cause, an `evaluation.conflicts.Conflict`. It is None if the cause is a prohibition that
    is in force since an earlier trigger.
    """

    def __init__(self, message: str, conflict: Any) -> None:
        super().__init__(message, "nothing was executed; `sleec-verify check` finds all such contexts")
        self.conflict = conflict


class Prohibited(ConflictInContext):
    """An obligation that is due, or was done, while a prohibition with a window forbids it.

    `over` is the first whole second, on the clock of the instance, at which it is no longer forbidden; None if it stays
    forbidden.
    """

    def __init__(self, message: str, obligation: str, over: int | None, hint: str) -> None:
        super().__init__(message, None)
        self.hint = hint
        self.obligation = obligation
        self.over = over


class NeedsAwait(SleecError):
    """A coroutine function among the variants of a trigger that is not awaited."""


class Reentrant(SleecError):
    """A call within a change of the same instance by the same thread: from a signal handler, a finalizer or a clock.
    It changes nothing."""

    def __init__(self) -> None:
        super().__init__(
            "this thread is already changing the instance",
            "in a signal handler, only record the signal, and call the instance from the main loop",
        )


class Forked(SleecError):
    """A call, in a process made by `os.fork`, of an instance that had pending obligations at the fork. The parent
    process continues with these."""

    def __init__(self) -> None:
        super().__init__(
            "this process is a fork of one with pending obligations, which continues with them",
            "load the rules again in this process; if the other process has ended, restore(…) what "
            "pending_snapshot() of this instance returns",
        )


class VariantsFailed(SleecError):
    """Errors of several variants of one dispatch. `errors` pairs the label of each rule with the error of its
    variant."""

    def __init__(self, errors: Sequence[tuple[str, BaseException]]) -> None:
        super().__init__(listed([f"{label}: {represent(error)}" for label, error in errors], "; "))
        self.errors = tuple(errors)


# Raised or reported while time passes ---------------------------------------------------------------------------


class DeadlineMissed(SleecError):
    """An obligation that was not fulfilled in its window, without an alternative.

    `until` is the end of the window, in seconds on the clock of the instance. It is None if an obligation without a
    window failed.
    """

    def __init__(self, message: str, obligation: str, until: object) -> None:
        super().__init__(message)
        self.obligation = obligation
        self.until = until


class StillRunning(SleecError):
    """Code, started by the clock, that does not return within `seconds`, the limit of the clock."""

    def __init__(self, seconds: float) -> None:
        super().__init__(
            f"its code has not returned after {seconds:g} seconds",
            "mark slow code with completes=False and return at once, or raise the limit of the clock",
        )
        self.seconds = seconds


class SnapshotRefused(SleecError):
    """A snapshot of pending obligations that cannot be taken or restored: it is malformed, of other rules, from a later
    time, or already restored. Nothing changes."""


# Raised for records of missions ----------------------------------------------------------------------------------


class MalformedObservation(SleecError):
    """An observation of a mission that is not in the form of docs/audit.md."""


class MappingError(SleecError):
    """A mapping of topics to names of a ruleset that is malformed, or does not fit the ruleset."""


class UnreadableLog(SleecError):
    """A log of a mission that cannot be read: missing, forbidden, of another form, or changed meanwhile."""


class UnwritableLog(SleecError):
    """A log of a mission that cannot be written: it exists, or its folder does not allow it."""


class NotEnforced(UserWarning):
    """Constructs of a ruleset that the runtime does not enforce. `constructs` pairs each with its line."""

    def __init__(self, message: str, constructs: Sequence[tuple[str, int]]) -> None:
        super().__init__(message)
        self.constructs = tuple(constructs)
