"""Cores: minimal reasons of a refutation, so that one exclusion covers as many situations as possible.

Rules and facts are removed one by one (deletion-based extraction of a minimal unsatisfiable subset; J. Marques-Silva,
"Minimal unsatisfiability: models, algorithms and applications", ISMVL 2010). Bounds on times are weakened by bisection.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Protocol

from sleec_verify.encoding.budget import as_far_as_decided
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.situations import Fact, Situations


class SituationQuestion(Protocol):
    """A question about a situation."""

    def refutes(self, facts: Collection[Fact]) -> bool:
        """Whether the answer to the question is "no" in all situations with these facts. Raises `Undecided`."""
        ...

    def gap(self, a: int, b: int) -> int:
        """The time from node `a` to node `b`, in seconds, in the last answer, which was yes."""
        ...


def minimal_rules(continuations: Continuations, rules: list[str]) -> list[str]:
    """A minimal set of `rules` that no response complies with. The last answer is then about that set."""
    first = set(continuations.core())
    kept = [label for label in rules if ("rule", label, True) in first]
    for label in list(kept):
        less = [other for other in kept if other != label]
        if not continuations.complies(less):
            core = set(continuations.core())
            kept = [other for other in less if ("rule", other, True) in core]
    stuck = not continuations.complies(kept)
    assert stuck, "a core is inconsistent by itself"
    return kept


def drop_slots(continuations: Continuations, rules: list[str], facts: list[Fact]) -> list[Fact]:
    """A core with as few slots as possible."""
    core = continuations.core()
    left_out: list[Fact] = []
    for number in sorted({int(str(f[1])) for f in core if f[0] == "slot"}, reverse=True):
        node = continuations.situations.slots[number].node
        about = [
            f for f in facts if (f[0] in ("slot", "came") and f[1] == number) or (f[0] == "gap" and node in f[1:3])
        ]
        if not continuations.complies(rules, [*left_out, *about]):
            left_out += about
    stuck = not continuations.complies(rules, left_out)
    assert stuck, "the facts that are left suffice"
    return continuations.core()


def weakest_facts(question: SituationQuestion, core: Collection[Fact], situations: Situations) -> list[Fact]:
    """Weaker facts than those of a core that are still refuted: as few as possible in addition to the rules, with
    bounds on times as weak as possible. It stops if that is undecided."""
    # A bound on the time of a slot has no effect unless the slot is pending.
    pending = {node: fact for fact in situations.facts_of_pending() for node in situations.nodes_of(fact)}
    facts = list(dict.fromkeys([*core, *(pending[n] for f in core if f[0] == "gap" for n in f[1:3] if n in pending)]))
    with as_far_as_decided():
        for fact in [fact for fact in facts if fact[0] not in ("rule", "gap")]:
            nodes = situations.nodes_of(fact)
            less = [f for f in facts if f != fact and not (f[0] == "gap" and nodes & {*f[1:3]})]
            if question.refutes(less):
                facts = less
        ages = {situations.now: 0}
        for _, a, b, most, _ in [fact for fact in facts if fact[0] == "gap"]:
            ages.update({a: most} if b == situations.now else {b: -most})  # type: ignore[dict-item, operator]
        bounds: list[Fact] = [("gap", a, b, ages[a] - ages[b], True) for a in ages for b in ages if a != b]
        # If the difference of two windows is the reason, no bound on now is needed.
        bounds.sort(key=lambda bound: situations.now not in bound[1:3])
        facts = [*(fact for fact in facts if fact[0] != "gap"), *bounds]
        for bound in bounds:
            less = [fact for fact in facts if fact != bound]
            facts = less if question.refutes(less) else [*less, _weakened(question, less, bound)]
    return facts


def _weakened(question: SituationQuestion, others: Collection[Fact], bound: Fact) -> Fact:
    """The weakest bound with which the facts are still refuted. Without the bound, the last answer was yes."""
    _, a, b, least, _ = bound
    assert isinstance(a, int), "a node"
    assert isinstance(b, int), "a node"
    assert isinstance(least, int), "a number of seconds"
    most = question.gap(a, b)
    while most - least > 1:
        middle = (least + most) // 2
        if question.refutes([*others, ("gap", a, b, middle, True)]):
            least = middle
        else:
            most = question.gap(a, b)
    return ("gap", a, b, least, True)
