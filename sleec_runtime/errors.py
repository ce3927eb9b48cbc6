"""The errors that a user can cause. Each says what is wrong and what to do; none needs a traceback."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_runtime.support.messages import LONGEST, bounded, escaped, listed, represent

if TYPE_CHECKING:
    from sleec_runtime.evaluation.conflicts import Conflict
    from sleec_runtime.model import Source, Span


class SleecError(Exception):
    """Base of every error that a user of sleec can cause.

    `message` says what is wrong, `hint` what to do about it (or None). Each has at most 2,000 characters; a longer
    one is cut.
    """

    def __init__(self, message: str, hint: str | None = None) -> None:
        self.message = bounded(message)
        self.hint = None if hint is None else bounded(hint)
        super().__init__(self.message)

    def __str__(self) -> str:
        """A line for each thing that is wrong, up to 4,000 characters. What could steer a terminal or forge a line is
        escaped."""
        return bounded("\n".join(map(escaped, self.sentences())), 2 * LONGEST)

    def sentences(self) -> list[str]:
        """Each thing that is wrong, with what to do about it, as it is."""
        return [f"{self.message} ({self.hint})" if self.hint else self.message]


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with a text of rules: where, what, and what to try."""

    message: str
    span: Span
    hint: str | None = None


class LanguageError(SleecError):
    """A text that is not a ruleset. It holds every problem that was found, in the order of the text."""

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
    """Something in a ruleset that a language has no words for."""


class UnreadableFile(SleecError):
    """A file that cannot be read as text: missing, forbidden, too large, no regular file, or not UTF-8 text."""


class CertificateRefused(SleecError):
    """A certificate that is none, or does not hold of the rules at hand. `problems` pairs each reason, one of those in
    docs/certificates.md, with a sentence on it."""

    def __init__(self, problems: Sequence[tuple[str, str]], hint: str | None = None) -> None:
        super().__init__("\n".join(message for _, message in problems), hint)
        self.problems = tuple(problems)

    def sentences(self) -> list[str]:
        messages = [message for _, message in self.problems]
        return [*messages[:-1], f"{messages[-1]} ({self.hint})" if self.hint else messages[-1]]


# What the runtime refuses, before anything is executed ----------------------------------------------------


class UnsupportedTimes(SleecError):
    """Rules with times, or relations, given to what cannot keep them. `lines` are those of the constructs."""

    def __init__(self, message: str, lines: Sequence[int], hint: str | None = None) -> None:
        super().__init__(
            message, hint or "leave them out, or leave it at `sleec-verify check`, `entail` and `explain` for now"
        )
        self.lines = tuple(lines)


class UnsupportedCalculations(SleecError):
    """Rules that calculate with several measures, given to what does not analyse that. `lines` are those of the
    calculations, 0 for one that is in no text."""

    def __init__(self, message: str, lines: Sequence[int]) -> None:
        super().__init__(
            message,
            "compare one measure with a number, or two measures; or leave it at `sleec-verify check`, `entail` and "
            "`explain`",
        )
        self.lines = tuple(lines)


class WrongArguments(SleecError, TypeError):
    """Arguments of a trigger that the code of one of its rules does not take. A TypeError too, as a call that does not
    fit is one."""


class WrongType(SleecError):
    """A value that does not fit its condition or measure; `name` is that of the condition or measure."""

    def __init__(self, name: str, value: object, expected: str, hint: str | None = None) -> None:
        super().__init__(f"{name} is {expected}, and {represent(value)} is not", hint)
        self.name = name


class UnknownName(SleecError, LookupError):
    """A name that the ruleset does not know. `name` is the name; the hint suggests the nearest known one."""

    kind = "name"
    holder = "the ruleset"

    def __init__(self, name: str, known: Iterable[str], hint: str | None = None) -> None:
        if not isinstance(name, str):
            article = "an" if self.kind[0] in "aeiou" else "a"
            hint = f"give the name of {article} {self.kind}, a str"
        super().__init__(f"unknown {self.kind} {represent(name)}", hint or self._suggestion(name, sorted(known)))
        self.name = name

    def _suggestion(self, name: str, known: Sequence[str]) -> str:
        from sleec_runtime.support.suggestions import nearest

        near = nearest(name, known)
        if near is not None:
            return f"did you mean {near}?"
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
    """Rules that have nothing to run, or not all of it: no method, or no variant for a clause that obliges something.
    `rules` are their labels."""

    def __init__(self, message: str, rules: Sequence[str], hint: str | None = None) -> None:
        super().__init__(message, hint)
        self.rules = tuple(rules)


class AlreadyBound(SleecError):
    """A second method for a rule: the method manager MM gives each rule one (paper, Section 3.2)."""


class Unbindable(SleecError):
    """What cannot be a rule's method: it is not marked, or something besides the rule would choose its variant."""


class UndeterminedDecision(SleecError):
    """What is due depends on what nobody reported: in strict mode on conditions; in any, on a measure that says how
    long a window is. `missing` names them."""

    def __init__(self, triggers: Sequence[str], missing: Sequence[str], hint: str | None = None) -> None:
        super().__init__(
            f"what {' and '.join(triggers)} calls for depends on what nobody reported: {listed(missing)}",
            hint or "report these with update(), or load the ruleset without strict",
        )
        self.missing = tuple(missing)


class ConflictInContext(SleecError):
    """What is due cannot all be done in this context, so nothing is. `conflict` holds the smallest cause; None where
    that is a prohibition that is in force since before."""

    def __init__(self, message: str, conflict: Conflict | None) -> None:
        super().__init__(message, "nothing was executed; `sleec-verify check` finds every such context beforehand")
        self.conflict = conflict


class Prohibited(ConflictInContext):
    """`obligation` is due, or was done, while a rule forbids it, by a prohibition with a window. From the second `over`
    on the instance's clock, it is forbidden no more; None if there is no such time."""

    def __init__(self, message: str, obligation: str, over: int | None, hint: str) -> None:
        super().__init__(message, None)
        self.hint = hint
        self.obligation = obligation
        self.over = over


class NeedsAwait(SleecError):
    """A coroutine function among the variants of a trigger that was not awaited."""


class Reentrant(SleecError):
    """A call that comes while the same thread is changing the same instance: from a signal handler, a finalizer, or a
    clock. It has changed nothing."""

    def __init__(self) -> None:
        super().__init__(
            "the thread of this call is in the middle of a change of the instance",
            "in a signal handler, only note that the signal came, and call the instance from the main loop",
        )


class Forked(SleecError):
    """A call in a process made by `os.fork`, of an instance with which something was pending then: the process that was
    forked goes on with that."""

    def __init__(self) -> None:
        super().__init__(
            "this process was forked from one in which something was pending, which goes on with it",
            "load the rules anew in this process; restore(…) there what pending_snapshot() of this instance returns if "
            "the other process has ended",
        )


class VariantsFailed(SleecError):
    """Several variants of one dispatch raised. `errors` pairs the label of each rule with what its variant raised."""

    def __init__(self, errors: Sequence[tuple[str, BaseException]]) -> None:
        super().__init__(listed([f"{label}: {represent(error)}" for label, error in errors], "; "))
        self.errors = tuple(errors)


# What happens while time passes ---------------------------------------------------------------------------


class DeadlineMissed(SleecError):
    """`obligation` was not done in its window, and no rule says what is due in its place. `until` is when that closed;
    None if it had no end, and what is due at once failed."""

    def __init__(self, message: str, obligation: str, until: object) -> None:
        super().__init__(message)
        self.obligation = obligation
        self.until = until


class StillRunning(SleecError):
    """Code that the clock started has not returned within `seconds`, the limit of the clock."""

    def __init__(self, seconds: float) -> None:
        super().__init__(
            f"its code has not returned after {seconds:g} seconds",
            "mark what takes long with completes=False and return at once, or raise the limit of the clock",
        )
        self.seconds = seconds


class SnapshotRefused(SleecError):
    """A snapshot of pending obligations that cannot be taken or restored: it is of other rules, malformed, later than
    the time of now, or restored twice. Nothing has changed."""


class NotEnforced(UserWarning):
    """What of a ruleset its runtime does not see to. `constructs` pairs what each is with its line."""

    def __init__(self, message: str, constructs: Sequence[tuple[str, int]]) -> None:
        super().__init__(message)
        self.constructs = tuple(constructs)
