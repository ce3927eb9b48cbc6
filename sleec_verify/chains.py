"""What becomes due once what is due is done, as a tree: doing an obligation triggers the rules of that name.

The measures stay as they are. Rules with "it happened" and "it is to be done" of one name (docs/semantics.md) are asked
one after the other: this is the question of its own that their causing each other is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sleec_runtime.model import Context, Ruleset
from sleec_verify.entailment import Because, Entailment, entail

DEEPEST = 100
"""Steps one below the other that are shown."""


@dataclass(frozen=True)
class Step:
    """Something that is done, and what that makes due: the active clauses of the rules that it triggers, each with the
    steps that its obligations are. `cycle`: it is being done already, further up; `seen`: its tree stands elsewhere;
    `more`: it goes on, too deep to be shown. `forbidden` are clauses of the tree so far that forbid it."""

    name: str
    clauses: tuple[tuple[Because, tuple[Step, ...]], ...] = ()
    cycle: bool = False
    seen: bool = False
    more: bool = False
    forbidden: tuple[str, ...] = ()

    @property
    def leads_on(self) -> bool:
        return bool(self.clauses) or self.cycle or self.seen or self.more


def chain(ruleset: Ruleset, context: Context, answer: Entailment) -> tuple[Step, ...]:
    """The steps that the obligations of `answer` are, those that lead on or are forbidden further down.

    Each event is expanded once, so the tree is linear in the clauses that it reaches.
    """
    triggers = {rule.trigger for rule in ruleset.rules}
    expanded: dict[str, tuple[Because, ...]] = {}
    forbidding: dict[str, list[str]] = {}
    _note_prohibitions(answer.because, forbidding)

    def because_of(name: str) -> tuple[Because, ...]:
        return entail(ruleset, Context(frozenset({name}), context.conditions)).because

    ahead = list(answer.obligations)
    while ahead:
        name = ahead.pop()
        if name in triggers and name not in expanded and name not in context.triggers:
            expanded[name] = because_of(name)
            _note_prohibitions(expanded[name], forbidding)
            ahead += (done for done, _ in _done_by(expanded[name]))

    def step(name: str, at_once: bool, path: tuple[str, ...], shown: set[str]) -> Step:
        # What is due at another time may be done when it is no longer forbidden.
        forbidden = tuple(forbidding.get(name, ())) if at_once else ()
        if name in path or name in context.triggers:
            return Step(name, cycle=name in triggers, forbidden=forbidden)
        if name not in expanded:
            return Step(name, forbidden=forbidden)
        if name in shown:
            return Step(name, seen=bool(expanded[name]), forbidden=forbidden)
        if len(path) == DEEPEST:
            return Step(name, more=True, forbidden=forbidden)
        shown.add(name)
        clauses = tuple(
            (because, tuple(step(done, now, (*path, name), shown) for done, now in _done_by((because,))))
            for because in expanded[name]
        )
        return Step(name, clauses, forbidden=forbidden)

    shown: set[str] = set()
    steps = tuple(step(name, now, (), shown) for name, now in _done_by(answer.because))
    return tuple(one for one in steps if one.leads_on or one.forbidden)


def _done_by(because: tuple[Because, ...]) -> Iterator[tuple[str, bool]]:
    """The obligations of clauses, each once, without the prohibitions; whether one is due at once."""
    found: dict[str, bool] = {}
    for one in because:
        for name, when in zip(one.obligations, one.times):
            if not name.startswith("NOT "):
                found[name] = found.get(name, False) or not when
    yield from found.items()


def _note_prohibitions(because: tuple[Because, ...], forbidding: dict[str, list[str]]) -> None:
    for one in because:
        for name, when in zip(one.obligations, one.times):
            if name.startswith("NOT ") and not when:
                forbidding.setdefault(name.removeprefix("NOT "), []).append(one.layer or one.rule)


def lines(steps: tuple[Step, ...], indent: str = "  ") -> Iterator[str]:
    """The tree as lines of text."""
    for step in steps:
        yield indent + step.name + _said(step)
        for because, done in step.clauses:
            yield f"{indent}  {because.layer or because.rule}: {' AND '.join(because.in_words()) or 'nothing'}"
            yield from lines(tuple(one for one in done if one.leads_on or one.forbidden), indent + "    ")


def _said(step: Step) -> str:
    words = []
    if step.cycle:
        words.append("which happens already: a cycle")
    elif step.seen:
        words.append("as above")
    elif step.more:
        words.append("and so on")
    if step.forbidden:
        words.append(f"which {' and '.join(step.forbidden)} {'forbids' if len(step.forbidden) == 1 else 'forbid'}")
    return f" ({'; '.join(words)})" if words else ""
