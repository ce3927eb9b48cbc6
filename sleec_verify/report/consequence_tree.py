"""A consequence tree as lines of text."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_verify.entailment.answer import ConsequenceStep


def lines(steps: tuple[ConsequenceStep, ...], indent: str = "  ") -> Iterator[str]:
    """The tree as lines of text."""
    for step in steps:
        yield indent + step.name + _said(step)
        for because, done in step.clauses:
            yield f"{indent}  {because.layer or because.rule}: {' AND '.join(because.in_words()) or 'nothing'}"
            yield from lines(tuple(one for one in done if one.leads_on or one.forbidden), indent + "    ")


def _said(step: ConsequenceStep) -> str:
    words = []
    if step.cycle:
        words.append("already in progress: a cycle")
    elif step.seen:
        words.append("as above")
    elif step.more:
        words.append("and so on")
    if step.forbidden:
        words.append(f"forbidden by {' and '.join(step.forbidden)}")
    return f" ({'; '.join(words)})" if words else ""
