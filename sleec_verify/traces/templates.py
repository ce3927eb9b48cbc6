"""Templates: continuations that depend on the situation as little as possible.

A template has acts of now, which cause everything that the rules require at once. Later instants have fixed events and
measures. They are at fixed times after now, or after the trigger of a pending demand. If a history can leave several
demands of one response, each of them that is not met otherwise has these instants (a *policy*).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from sleec_runtime.model import Value
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.demands import Demand, Occurs, conjuncts, simplified
from sleec_verify.traces.pending_demands import Pending


@dataclass(frozen=True)
class Later:
    """An instant of a template, `seconds` after its reference node, with its events and state, the demands of the
    rules that are triggered there, and the `when … until` and `when … for` that begin, hold or end there, by their
    keys."""

    seconds: int
    events: frozenset[str]
    state: frozenset[tuple[str, Value]]
    demands: tuple[tuple[str, Demand], ...]
    begins: frozenset[str]
    holds: frozenset[str]
    ends: frozenset[str]


@dataclass(frozen=True)
class Template:
    """`acts` are done now, in addition to what the rules require at once. Then follow the instants of `later`, in
    this order, each relative to a node, and those of the policies."""

    acts: frozenset[str] = frozenset()
    later: tuple[tuple[int, Later], ...] = ()
    policies: tuple[tuple[Pending, tuple[Later, ...]], ...] = ()

    def policy(self, pending: Pending) -> tuple[Later, ...]:
        """The policy for a pending demand: its own, or that of the same response with other lengths of its windows."""
        known = dict(self.policies)
        if pending in known:
            return known[pending]
        for other, policy in self.policies:
            if other.obligation is pending.obligation and other.number == pending.number and other.rule is pending.rule:
                moved = [_moved(later.seconds, other.atoms, pending.atoms) for later in policy]
                if None not in moved:
                    return tuple(
                        replace(later, seconds=seconds) for later, seconds in zip(policy, moved) if seconds is not None
                    )
        return ()


def _moved(seconds: int, atoms: Sequence[Occurs], others: Sequence[Occurs]) -> int | None:
    """A time that is as far from a bound of the windows of `others` as `seconds` is from the nearest bound of those of
    `atoms`; None if these are not the same windows with other bounds."""
    if [(one.event, one.negated) for one in atoms] != [(one.event, one.negated) for one in others]:
        return None
    bounds = [
        (own, other)
        for one, another in zip(atoms, others)
        for own, other in ((one.start, another.start), (one.end, another.end))
        if own is not None and other is not None
    ]
    if not bounds:
        return None
    own, other = min(bounds, key=lambda bound: abs(bound[0] - seconds))
    return seconds - own + other


def templates_of(found: Continuations) -> Iterator[Template]:
    """Templates of the last continuation of `found.complies`: with the earliest and the latest times, each instant
    relative to what it waits for; and with times in between, all relative to now, which always fits."""
    now = found.now
    found.model.reduce([one.guard for one in found.model.decided if one.at != now])
    earliest, waits = found.model.schedule()
    latest, limits = found.model.schedule(now)
    first, second = _template(found, earliest, waits), _template(found, latest, limits)
    # Constraints are differences, so the mean of two solutions is a solution.
    middle = _template(found, {node: (time + latest[node]) // 2 for node, time in earliest.items()}, {})
    yield from (first, second, replace(middle, policies=second.policies))


def _template(found: Continuations, times: Mapping[int, int], waits: Mapping[int, tuple[int, int]]) -> Template:
    model, situations = found.model, found.situations
    node_of = {node: number for number, node in found.nodes.items()}
    several = {slot.node: slot.pending for slot in situations.slots if not slot.pending.is_single}
    fixed: list[tuple[int, Later]] = []
    plans: dict[int, list[Later]] = {}
    nodes = [node for node in model.used() if node in model.instants and node != found.now]
    for node in sorted(nodes, key=lambda n: times[n]):
        anchor, wait = node, 0
        while anchor not in node_of:
            anchor, more = waits.get(anchor, (found.now, times[anchor] - times[found.now]))
            wait += more
        later = _later(found, node, wait)
        if node_of[anchor] in several:
            plans.setdefault(node_of[anchor], []).append(later)
        else:
            fixed.append((node_of[anchor], later))
    # One policy for each response: that of the slot with the most instants.
    chosen = {several[slot]: tuple(plan) for slot, plan in sorted(plans.items(), key=lambda item: len(item[1]))}
    return Template(_acts(found), tuple(fixed), tuple(chosen.items()))


def _later(found: Continuations, node: int, seconds: int) -> Later:
    model = found.model
    events = model.events(node)
    demands = tuple(
        (one.rule.label, simplified(one.due, _truths(found, one.due)))
        for one in model.decided
        if one.at == node and model.true(one.guard)
    )
    laws = [(key, law) for key, (law, _, _) in found.situations.lasting.items()]
    return Later(
        seconds,
        events,
        frozenset(model.values(node).items()),
        demands,
        begins=frozenset(
            key for key, law in laws if law.event in events and model.true(model.condition(node, law.condition))
        ),
        holds=frozenset(key for key, law in laws if model.true(model.condition(node, law.formula))),
        ends=frozenset(
            key for key, law in laws if law.end in events and model.true(model.condition(node, law.end_condition))
        ),
    )


def _truths(found: Continuations, demand: Demand) -> dict[int, bool]:
    if isinstance(demand, int):
        return {demand: found.model.true(demand)}
    if isinstance(demand, Occurs):
        return {}
    return {literal: value for part in demand.parts for literal, value in _truths(found, part).items()}


def _acts(found: Continuations) -> frozenset[str]:
    """The events of now that are neither inputs nor required at once by inputs or other events of now."""
    model, now = found.model, found.now
    occurring = {str(fact[1]) for fact in found.facts if fact[0] == "input" and fact[-1]}
    required = [
        (one.rule.trigger, what.event)
        for one in model.decided
        if one.at == now and model.true(one.guard) and model.true(model.in_force(one.rule.label))
        for what in conjuncts(one.due)
        if what.is_immediate and not what.negated
    ]
    grew = True
    while grew:
        fresh = {event for trigger, event in required if trigger in occurring} - occurring
        occurring |= fresh
        grew = bool(fresh)
    return model.events(now) - occurring
