"""Policies: how to go on after now, whatever the history was, as far as it suits the history at all.

A policy does some events *soon*: as soon after now as a response calls for them, a second after now at the earliest.
Others it does *late*, if anything calls for them without end: at an instant of their own, once all that forbids them
for some time only is over. All further ones are not done after now. Of the soon ones, some are done at exactly the
first second that a response of the history allows, some at the last, and some wait until all that the history forbids
for some time is over, and all that it calls for of what they rule out is done. The measures are the same at all
instants at which soon ones are done, and at all late instants. So:

- what calls for an event that is done soon is met, if there is time left after now; and what calls for one that is done
  late, if there is no end to it;
- what forbids an event that is not done is kept from now on, and so is what forbids, for some time, one done late;
- what an event of the policy calls for, and what laws demand of it, has to be met in this way too: the policy is
  *closed*, which is a question about one instant at which all that is done soon occurs, and one of what is done late.

Where responses do not come back to their own trigger, the trace ends, as it has to.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from typing import Literal, NamedTuple

from sleec_runtime.model import Rule
from sleec_verify.timed.program import Law, Program, excluding

Style = Literal["plain", "busy", "patient"]
"""Of the policies that suit a history, one that does and waits for as little as it can; or that does more, if it is
called for; or that waits for as much as it can."""


class Policy(NamedTuple):
    """The events that are done soon after now, and late. Of those done soon, the ones that are done in the `next`
    second only, as no response calls for them later; at the `first` or the `last` second only that a response of the
    history allows, as nothing else calls for them; and once all is over that forbids them for some time, or calls for
    what they forbid (`waiting`).
    The laws of these names are to be `over`: it suits no history in which one of them is in force after now."""

    soon: frozenset[str] = frozenset()
    late: frozenset[str] = frozenset()
    next: frozenset[str] = frozenset()
    first: frozenset[str] = frozenset()
    last: frozenset[str] = frozenset()
    waiting: frozenset[str] = frozenset()
    over: frozenset[str] = frozenset()

    @property
    def events(self) -> frozenset[str]:
        return self.soon | self.late

    @property
    def awaited(self) -> frozenset[str]:
        """The events that are done at times of their own. If now is the last time at which one can be done that an
        instant before now calls for, and nothing in its place, it is done now."""
        return self.first | self.last | self.waiting


def ruled_out(program: Program, rules: Iterable[Rule], laws: Iterable[Law]) -> dict[str, set[str]]:
    """For each event, the others that some of these rules may forbid from it on, or that laws exclude with it."""
    found: dict[str, set[str]] = defaultdict(set)
    for rule in rules:
        found[rule.trigger].update(what.event for what in program.windows(rule) if what.negated)
    for left, right in (pair for law in laws for pair in excluding(law)):
        found[left].add(right)
        found[right].add(left)
    for event, others in found.items():
        others.discard(event)
    return found
