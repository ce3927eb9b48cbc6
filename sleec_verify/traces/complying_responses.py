"""Responses that show that no rule of a conflict can be left out: each complies with all rules but one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_verify.results.conflict_freedom import Example
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.histories import Histories
from sleec_verify.traces.used_templates import contested_rule


def complying_responses(continuations: Continuations, rules: Sequence[str]) -> Iterator[Example]:
    """For each rule of a conflict, a response that complies with the others in its situation, after a lawful history.
    None if no history leads to exactly the abstract situation. Raises `Undecided`."""
    s = continuations.situations
    if s.index.stated is not s.index:
        return
    histories = Histories(s, s.facts(), rules)
    if not histories.exist():
        return
    moments, now = histories.history()
    for label in rules:
        others = [other for other in rules if other != label]
        if not continuations.complies(others):
            continue
        model = continuations.model
        times, _ = model.schedule()
        nodes = sorted((node for node in model.used() if node in model.instants), key=lambda node: times[node])
        instants = [model.at(node, now + times[node] - times[continuations.now]) for node in nodes]
        kept = tuple(contested_rule(s, s.index.ruleset.by_label[other]) for other in others)
        yield Example(kept, (*moments, *instants), len(moments))
