"""The details of a finding: its witness, the domains, the note and the help."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.wording.phrases import listed, witness_text
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_verify.results.finding import Finding


class Detail(NamedTuple):
    """A detail with its title, in one line (`text`) or several (`lines`)."""

    title: str
    text: str = ""
    lines: tuple[str, ...] = ()


def details(finding: Finding, chart: bool = False) -> Iterator[Detail]:
    """The details of a finding. With `chart`, a timeline is drawn as well."""
    if finding.timeline is not None:
        from sleec_verify.report import timeline

        yield Detail(sentence("timeline"), lines=tuple(timeline.in_words(finding.timeline)))
        if chart:
            yield Detail(sentence("chart"), lines=tuple(timeline.chart_of(finding.timeline)))
    elif finding.strategy is not None:
        from sleec_verify.report import strategy

        yield Detail(sentence("strategy of the environment"), lines=tuple(strategy.in_words(finding.strategy)))
    elif finding.witness is not None:
        yield Detail(sentence("situation"), witness_text(finding.witness))
    if finding.domains:
        yield Detail(sentence("domain"), listed(finding.domains))
    if finding.note is not None:
        yield Detail(sentence("note"), finding.note)
    if finding.help is not None:
        yield Detail(sentence("help"), finding.help)
