"""A consequence tree as lines of text."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_verify.entailment.answer import ConsequenceStep
from sleec_verify.wording.phrases import listed
from sleec_verify.wording.sentence import joined, sentence


def lines(steps: tuple[ConsequenceStep, ...], indent: str = "  ") -> Iterator[str]:
    """The tree as lines of text."""
    for step in steps:
        yield joined("", [indent, step.name, _said(step)])
        for because, done in step.clauses:
            due = " AND ".join(because.in_words()) or sentence("nothing")
            yield joined("", [f"{indent}  {because.layer or because.rule}: ", due])
            yield from lines(tuple(one for one in done if one.leads_on or one.forbidden), indent + "    ")


def _said(step: ConsequenceStep) -> str:
    words: list[str] = []
    if step.cycle:
        words.append(sentence("already in progress: a cycle"))
    elif step.seen:
        words.append(sentence("as above"))
    elif step.more:
        words.append(sentence("and so on"))
    if step.forbidden:
        words.append(sentence("forbidden by {clauses}", clauses=listed(step.forbidden)))
    return joined("", [" (", joined("; ", words), ")"]) if words else ""
