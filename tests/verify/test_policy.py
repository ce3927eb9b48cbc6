"""Policies: what each of them does is played second by second, and replayed by the evaluator of traces; what few plans
decide is decided without any policy as well; and examples, one for each thing that the docstring says."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import product
from random import Random

import pytest

from sleec_runtime.evaluation import decide
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_runtime.model_time import Effect, EventRelation, Lasting
from sleec_runtime.trace import Instant, Trace, _Replay, broken
from sleec_verify.timed import conflicts
from sleec_verify.timed.conflict_cone import Cone
from sleec_verify.timed.conflicts import FEW_PLANS, _partial, conflict
from sleec_verify.timed.free import Free
from sleec_verify.timed.histories import Search, Tried
from sleec_verify.timed.plans import Plan
from sleec_verify.timed.policies import Policies, can_come_late
from sleec_verify.timed.policy import Policy, Style, ruled_out
from sleec_verify.timed.program import Program, events_of, law_name
from tests.timed_agreement import SIZES, answered
from tests.timed_strategies import timed_ruleset
from tests.verify.test_conflict_cone import sparse

# What a policy does, played -------------------------------------------------------------------------------


class Played:
    """A history continued by a policy: with the measures `soon` at all instants at which soon events are done, and with
    `late` at all late ones. What is due over some time is done at the same instant if that is `eager`, or else later.
    """

    def __init__(self, ruleset, laws, untimed, history, policy, soon, late, eager):
        self.ruleset, self.laws, self.policy = ruleset, laws, policy
        self.soon, self.late, self.eager = soon, late, eager
        self.replay = _Replay(ruleset, (), untimed)
        self.instants = list(history)
        # For each response that something has triggered, what it takes, in each of the ways to keep it.
        self.due = [ways for instant in history for ways in self.triggered(instant)]
        forbidden = [leaf for ways in self.due for way in ways for leaf in way if leaf.negated]
        self.over = {one.event: 0 for one in forbidden}
        for one in forbidden:
            self.over[one.event] = max(self.over[one.event], one.last or 0)
        # What waits comes after all that the history calls for of what it forbids.
        calls = [one for one in self.calls(self.due) if one.event in self.policy.soon and one.last is not None]
        for event, others in ruled_out(Program(ruleset, untimed), ruleset.rules, laws).items():
            ends = [one.last for one in calls if one.event in others]
            self.over[event] = max([self.over.get(event, 0), *ends])
        while self.goes_on and (self.soon_one() or self.late_one()):
            pass

    @property
    def goes_on(self):
        """Whether what it does may still come to an end; with measures that do not suit it, it may not."""
        return len(self.instants) < 200

    def triggered(self, instant):
        for rule in self.ruleset.rules:
            context = Context(instant.events, instant.conditions)
            decision = decide(rule, context, self.ruleset.reading, self.ruleset.measures)
            for obligation in () if decision is None else decision.obligations:
                yield list(self.replay._ways_of(obligation, instant.time, instant))

    def occurred(self, one):
        return any(one.event in instant.events and one.covers(instant.time) for instant in self.instants)

    def calls(self, due):
        """What the responses that are not met yet call for, whether or not it can be done."""
        after = self.instants[-1].time + 1
        for ways in due:
            left: list[object] = []
            for way in ways:
                over = [one.last is not None and one.last < after for one in way]
                happened = [self.occurred(one) for one in way]
                if all(h if not one.negated else o and not h for one, o, h in zip(way, over, happened)):
                    left = []
                    break
                if not any(h if one.negated else o and not h for one, o, h in zip(way, over, happened)):
                    left += [one for one, h in zip(way, happened) if not one.negated and not h]
            yield from left

    def soon_one(self):
        after = self.instants[-1].time + 1
        called = [(self.time_of(one, after), one) for one in self.calls(self.due) if one.event in self.policy.soon]
        called = [(time, one) for time, one in called if one.covers(time)]
        if not called:
            return False
        time = min(time for time, _ in called)
        self.add(time, {one.event for when, one in called if when == time}, self.soon, self.policy.soon)
        return True

    def time_of(self, one, after):
        if one.event in self.policy.last:
            return max(after, one.last)
        return max(after, one.first, 1 + self.over.get(one.event, 0) if one.event in self.policy.waiting else 0)

    def late_one(self):
        called = [one for one in self.calls(self.due) if one.last is None and one.event in self.policy.late]
        if not called:
            return False
        one = min(called, key=lambda one: (one.first, one.event))
        leaves = [leaf for ways in self.due for way in ways for leaf in way]
        over = [leaf.last for leaf in leaves if leaf.negated and leaf.last is not None]
        self.add(max(one.first, 1 + max([self.instants[-1].time, *over])), {one.event}, self.late, self.policy.events)
        return True

    def add(self, time, events, values, allowed):
        """An instant, with all that is due at once, or comes of the laws."""
        is_late = allowed is not self.policy.soon
        before, size = list(self.instants), -1
        while len(events) > size:
            size = len(events)
            here = Instant(time, frozenset(events), values)
            self.instants = [*before, here]
            due = list(self.triggered(here))
            for ways in due:
                for one in (one for way in ways for one in way):
                    waits = one.event in self.policy.waiting and time <= self.over.get(one.event, 0)
                    at_once = one.last == time or (self.eager and not is_late and not waits)
                    if not one.negated and one.event in allowed and one.covers(time) and at_once:
                        events |= {one.event}
            events |= {event for law in self.laws for event in self.demanded(law, here)}
        self.due += due

    def demanded(self, law, here):
        if isinstance(law, EventRelation) and law.relation in ("witness", "equal"):
            if law.left in here.events:
                yield law.right
            if law.relation == "equal" and law.right in here.events:
                yield law.left
        elif isinstance(law, Effect) and law.relation == "causation" and self.replay._holds(law.formula, here):
            yield law.event


def valuations(ruleset):
    named = {name: [False, True] for name in ("m", "n")}
    for name, measure in ruleset.measures.items():
        named[name] = list(getattr(measure, "values", None) or [False, True])
    return [dict(zip(named, values)) for values in product(*named.values())]


def play(search, inner, now, plan):
    """Why the history that a plan continues by its policy is not kept by any measures; None if it is."""
    program, cone = search.program, search.cone
    laws = [law for law in program.laws if cone.events.issuperset(events_of(law))]
    measures = tuple(program.ruleset.measures.values())
    ruleset = replace(program.ruleset, statements=(*laws, *cone.rules.values()), inferred=measures)
    times, _ = inner.schedule()
    history = [Instant(times[n], inner.happening(n), inner.values(n)) for n in inner.used() if n <= now]
    every = valuations(program.ruleset)
    for eager in (False, True):
        tried = []
        for soon, late in product(every, every if plan.policy.late else every[:1]):
            played = Played(ruleset, laws, program.untimed, history, plan.policy, soon, late, eager)
            found = broken(ruleset, Trace(tuple(played.instants)), program.untimed)
            if not found and played.goes_on:
                break
            tried.append((played.instants[len(history) :], found))
        else:
            return f"{eager=}\n{plan}\n{history}\n" + "\n".join(map(str, tried[:3]))
    return None


def mixed(seed, text):
    """A text with windows of seconds, minutes and hours, and without end."""
    draw = Random(seed)

    def window(found):
        eventually = " EVENTUALLY" if "WITHIN" in found[0] else " eventually"
        units = [found[0].replace("seconds", unit) for unit in ("seconds", "seconds", "minutes", "hours")]
        return eventually if draw.random() < 0.3 else draw.choice(units)

    return re.sub(r" (within|WITHIN) [^a-z]*seconds", window, text)


@pytest.fixture
def played(monkeypatch):
    """Searches for conflicts of all rules of a text, with few instants before now, of which each way to go on by a
    policy is played. Returns these policies."""
    found = []
    ways = Search._ways

    def all_played(search, inner, now, unseen):
        for plan in ways(search, inner, now, unseen):
            # Where only a part of the history is known, it is not clear what is to be done.
            if plan.policy is not None and not search.outer.left_out.instants:
                why = play(search, inner, now, plan)
                assert why is None, f"{search.rule.label}: {why}\n{search.program.ruleset.source.text}"
                found.append(plan.policy)
            yield plan

    monkeypatch.setattr(Search, "_ways", all_played)
    # What has an answer without a search is played as well.
    monkeypatch.setattr(Free, "is_free_now", lambda self, demand, *_, **__: self.is_free(demand))

    def run(text, untimed="at"):
        program = Program(parse(text), untimed)
        for rule in program.rules if program.is_acyclic else ():
            cone = Cone(program, rule)
            for instants, style in PLAYED:
                search = Search(program, rule, cone, Tried(instants, style=style))
                answered(search.find)
        return found

    return run


PLAYED: list[tuple[int, Style]] = [(0, "plain"), (1, "plain"), (1, "busy"), (1, "patient"), (2, "plain")]
UNTIMED = ("at", "eventually")


def played_texts(run, seed):
    untimed = UNTIMED[seed % 7 == 0]
    text = timed_ruleset(seed, **SIZES[seed % 3]).source.text
    run(text, untimed)
    run(text.replace(" seconds", " minutes"), untimed)
    run(mixed(seed, text), untimed)
    return run(mixed(seed, sparse(seed)), untimed)


@pytest.mark.parametrize("first", [0, 30, 60, 90])
def test_what_a_policy_does_keeps_all(first, played):
    for seed in range(first, first + 30):
        found = played_texts(played, seed)
    assert any(policy.soon for policy in found)
    assert any(policy.waiting for policy in found)


@pytest.mark.parametrize("seed", [10, 72])
def test_what_is_done_at_the_last_second_keeps_all(seed, played):
    assert any(policy.last for policy in played_texts(played, seed))


OVER = ["forbid A {m}\nwhen D then {m} until C", "forbid A {m}\nwhen D and {n} then {m} for 2 minutes"]


@pytest.mark.parametrize("relations", OVER)
def test_what_is_done_after_laws_are_over_keeps_all(relations, played):
    rules = "r when C then A within [1, 1] minutes\ns when E then D within [5, 9] minutes"
    policies = played(written(rules, relations))
    assert any(policy.over for policy in policies)
    assert not any(policy.over and "D" in policy.events for policy in policies)


@pytest.mark.parametrize("unit", ["seconds", "minutes"])
def test_what_is_done_late_keeps_all(unit, played):
    for seed in range(12, 18):
        found = played(sparse(seed).replace("seconds", unit))
    assert any(policy.late for policy in found)


@pytest.mark.long
@pytest.mark.parametrize("first", range(100, 1_000, 50))
def test_what_many_policies_do_keeps_all(first, played):
    for seed in range(first, first + 50):
        played_texts(played, seed)
        played(sparse(seed).replace("seconds", ("seconds", "minutes")[seed % 2]))


# What few plans decide ------------------------------------------------------------------------------------


def without_policies(monkeypatch):
    """Conflicts are looked for without any policy: by instants that each history is continued with."""
    monkeypatch.setattr(Policies, "suiting", lambda *_: None)
    monkeypatch.setattr(Free, "comes_late", lambda *_: False)
    monkeypatch.setattr(conflicts, "MOST_PAST", 2)

    def no_few_plans(*args):
        return tuple([one for one in tried if not one.from_now] for tried in _partial(*args))

    monkeypatch.setattr(conflicts, "_partial", no_few_plans)


def few_plans_decide(ruleset, monkeypatch):
    """The rules of which few plans decide that all histories go on, and how many of these were looked at again."""
    program, other = Program(ruleset), Program(ruleset)
    decided = again = 0
    for rule in program.rules if program.is_acyclic else ():
        cone = Cone(program, rule)
        for instants, style in FEW_PLANS:
            few = Search(program, rule, cone, Tried(instants, True, from_now=True, style=style))
            search = answered(lambda: (few.find(),))  # noqa: B023
            if search == (None,):
                decided += 1
                with monkeypatch.context() as patch:
                    without_policies(patch)
                    found = answered(lambda: (conflict(other, rule),))  # noqa: B023
                assert found is None or found[0] is None, f"{rule.label}: {found}\n{ruleset.source.text}"
                again += found is not None
                break
    return decided, again


@pytest.mark.parametrize("first", [0, 60])
def test_what_few_plans_decide_is_so_without_policies(first, monkeypatch):
    found = [few_plans_decide(timed_ruleset(seed, **SIZES[seed % 2]), monkeypatch) for seed in range(first, first + 60)]
    assert sum(again for _, again in found) > 5


@pytest.mark.long
@pytest.mark.parametrize("first", range(100, 1_000, 50))
def test_what_few_plans_decide_of_many_is_so_without_policies(first, monkeypatch):
    for seed in range(first, first + 50):
        few_plans_decide(timed_ruleset(seed, **SIZES[seed % 3]), monkeypatch)
        few_plans_decide(parse(sparse(seed)), monkeypatch)


BETWEEN = ["happenBefore {0} {1}", "when {0} and {{m}} then (not {{m}}) until {1}", "when {0} then {{m}} until {1}"]


def with_law(seed, law):
    """A random text with a law about two of its events."""
    text = timed_ruleset(seed, **SIZES[seed % 3]).source.text.replace(" seconds", " minutes")
    events = Random(seed).sample(re.findall(r"event (\w+)", text), 2)
    law = f"  {law.format(*events)}\n"
    if "relation_start" in text:
        return text.replace("relation_start\n", f"relation_start\n{law}")
    return text.replace("rule_end\n", f"rule_end\nrelation_start\n{law}relation_end\n", 1)


@pytest.mark.parametrize("law", BETWEEN)
def test_what_came_before_may_be_left_out(law):
    """A search for parts of histories has one of each conflict among them, however few instants a part has."""
    conflicts = 0
    for seed in range(5_640, 5_820):
        program = Program(parse(with_law(seed, law)))
        for rule in program.rules if program.is_acyclic else ():
            cone = Cone(program, rule)
            found = [answered(Search(program, rule, cone, Tried(instants)).find) for instants in (0, 1, 2)]
            if any(found):
                conflicts += 1
                for instants, style in ((1, "plain"), *FEW_PLANS[:2]):
                    search = Search(program, rule, cone, Tried(instants, True, from_now=True, style=style))
                    found_in_part = answered(lambda: (search.find(),))  # noqa: B023
                    assert found_in_part != (None,), f"{rule.label}\n{program.ruleset.source.text}"
    assert conflicts > 5


# One thing each -------------------------------------------------------------------------------------------


def written(rules, relations=""):
    events = "".join(f"  event {event}\n" for event in "ABCDEF")
    text = f"def_start\n{events}  measure m: boolean\n  measure n: boolean\ndef_end\nrule_start\n{rules}\nrule_end\n"
    return f"{text}relation_start\n{relations}\nrelation_end\n" if relations else text


GO_ON = {
    "what is due in a window that opens later": written("""r when C then A within [1, 2] minutes
        s when A then not C unless {m}"""),
    "what is forbidden is not done": written("r when D then C within 3 minutes otherwise not D", "equal A C"),
    "and what is done in its place": written(
        """r when D then C within [1, 3] minutes otherwise E
        s when D then not A within [1, 5] minutes""",
        "equal A C",
    ),
    "what is done late waits for what is over": written("""r when B then A eventually
        s when C then not A within 5 minutes"""),
    "each of several late ones does": written("""r when B then A eventually
        s when D then F eventually
        t when C then not A within 5 hours
        u when A then not F within 2 hours"""),
    "what comes at once with a late one waits, too": written("""r when B then A eventually
        s when A then D within 5 minutes
        t when E then not A within 2 hours"""),
    "what is due soon after a late one": written("""r when B then A eventually
        s when C then not A within 5 minutes
        t when E then A within 1 minutes otherwise D"""),
    "what is forbidden later is done in the next second": written("""r when B then A within 5 minutes
        s when C then not D
        t when D then not A within [1, 2] minutes otherwise C"""),
    "measures are others when late ones are done": written("""r when B then A within [1, 2] minutes
        s when A then not A unless {m}
        t when C then D eventually
        u when D then not D unless (not {m})
        v when E then not D within 5 minutes"""),
    "what a policy calls for is met by it": written("""r when B then A within [1, 2] hours
        s when A then D within 2 minutes
        t when D then not B"""),
    "what does not come back to its trigger, by its measures": written("""r when B then A eventually
        s when A then B within 2 minutes unless {m}
        t when C then not A within 5 minutes"""),
    "what has happened before": written(
        """r when B then A eventually
        s when C then not A within 5 minutes""",
        "happenBefore B A",
    ),
    "what has to happen before is done now": written("r when C then A within [1, 2] minutes", "happenBefore B A"),
}


@pytest.mark.parametrize("text", GO_ON.values(), ids=GO_ON.keys())
def test_all_go_on(text, played):
    program = Program(parse(text))
    assert [conflict(program, rule) for rule in program.rules] == [None] * len(program.rules)
    played(text)


STUCK = {
    "what is forbidden without end": written("r when B then A eventually\ns when C then not A eventually"),
    "what a late one calls for at once, without end": written("""r when B then A eventually
        s when A then D
        t when C then not D eventually"""),
    "what a soon one calls for": written("""r when B then A within [1, 2] hours
        s when A then D within 2 minutes
        t when C then not D within 3 hours"""),
    "measures that suit nothing": written("""r when B then A within [1, 2] minutes
        s when A then not A unless {m}
        t when A then not A unless (not {m})"""),
    "what has to happen before": written(
        """r when C then A within 3 minutes
        s when D then not B within 5 minutes""",
        "happenBefore B A",
    ),
}


@pytest.mark.parametrize("text", STUCK.values(), ids=STUCK.keys())
def test_some_do_not(text, played):
    program = Program(parse(text))
    found = conflict(program, program.ruleset.by_label["r"])
    assert found is not None
    assert len(found.instants) == 1
    played(text)


FEW_DO = {
    "what is done at the last second": "r when C then B within 1 minutes unless {m} then not C within 1 minutes\n"
    "otherwise not B",
    "what other measures would call for": """r when B then A within [0, 3] minutes otherwise not C within 1 minutes
        s when A and (not {m}) then C within 3 minutes""",
    "what waits until all is done that it forbids": """r when B then A within 15 seconds
        s when C then D within 2 seconds
        t when A then not D within 3 seconds""",
    "what waits until it is not forbidden": """r when B then A within 10 minutes
        s when C then not A within 2 minutes""",
    "what is brought, and waits": """r when B then A within 1 minutes
        s when A then D within [1, 2] hours
        t when C then not D within 30 minutes""",
    "what comes at a time of its own": """r when B then A within [3, 3] minutes
        s when B then not A within [1, 1] minutes""",
    "what waits for more than one thing": """r when B then A within 10 minutes otherwise D within 5 minutes
        s when C then not A within 2 minutes
        t when E then not D within 3 minutes""",
}


FEW_DO_BY_LAWS = {
    "what waits until all is done that it excludes": (
        """r when C then A within 3 minutes
        s when B then D within 2 seconds""",
        "mutualExclusive A D",
    ),
    "what a law forbids that is over": (
        "r when C then A within [1, 1] minutes",
        "forbid A {m}\nwhen D then {m} until C",
    ),
    "what would come of other measures": (
        "r when B then A within [3, 3] minutes\ns when B then not A within [1, 1] minutes",
        "causation A {m}",
    ),
    "what ends in the instant in which it began": (
        """r when C then D otherwise not A eventually else not A otherwise D within [1, 3] minutes
            else D within 1 minutes""",
        "when C and {n} then (not {n}) until A\nincludes A {n}",
    ),
    "what never occurs, as something comes with it that is forbidden": (
        """r when C then D
        s when B then A within 2 minutes
        t when B then C unless {m} then {not D eventually}""",
        "equal A D",
    ),
}


@pytest.mark.parametrize(
    "text", [(rules, "") for rules in FEW_DO.values()] + [*FEW_DO_BY_LAWS.values()], ids=[*FEW_DO, *FEW_DO_BY_LAWS]
)
def test_few_plans_do_for(text):
    program = Program(parse(written(*text)))
    rule = program.ruleset.by_label["r"]
    searches = (
        Search(program, rule, Cone(program, rule), Tried(few, True, from_now=True, style=style))
        for few, style in FEW_PLANS
    )
    assert (None,) in [answered(lambda: (search.find(),)) for search in searches]  # noqa: B023


def test_what_comes_with_something_else_does_not_wait(played):
    rules = """r when B then A within 10 minutes
        s when C then not A within 2 minutes
        t when E then D within 5 minutes"""
    policies = played(written(rules, "equal A D"))
    assert any("A" in policy.soon for policy in policies)
    assert not any("A" in policy.waiting for policy in policies if "D" in policy.events)


@pytest.mark.parametrize(
    ("awaited", "faults"),
    [("", 1), ("A", 2), ("D", 3), ("AD", 3), ("E", 2), ("F", 1)],
)
def test_what_shows_that_a_policy_does_not_suit(awaited, faults):
    """That which calls for something, and what stands in the way of each thing that would do."""
    program = Program(
        parse(
            written("""r when B then A within 1 minutes otherwise D within 1 minutes
            s when D then A
            t when C then not E within 1 minutes unless {m} then {not E unless {n} then not E within 2 minutes}""")
        )
    )
    policies = Policies(program, program.ruleset.by_label, set("ABCDEF"))
    assert policies.faults(Policy(waiting=frozenset(awaited))) == faults


def test_each_event_of_a_law_may_be_due_by_an_instant_of_its_own():
    rules = "".join(f"WHEN {trigger} THEN {event} WITHIN 1 minute\n" for trigger, event in ("BA", "CD", "FE"))
    program = Program(parse(f"{rules}NEVER A AND D AND E"))
    assert Policies(program, program.ruleset.by_label, set("ABCDEF")).faults(Policy(waiting=frozenset("ADE"))) == 3


# After all else -------------------------------------------------------------------------------------------

CALLED = "k when B then C"
LATE = [
    (True, "r when C then not A within 5 hours", ""),
    (False, "r when C then not A eventually", ""),
    (True, "r when A then B within 2 minutes\ns when C then not B within 5 minutes", ""),
    (False, "r when A then B within 2 minutes\ns when C then not B eventually", ""),
    (False, "r when A then not A", ""),
    (False, "r when A then not A within 5 minutes", ""),
    # It would have to be done again, or so it seems.
    (False, "r when A then A within 2 minutes", ""),
    (False, "r when A then B within 2 minutes\ns when B then A within 2 minutes unless {m}", ""),
    # Whatever holds at its instant, B occurs there, or only if m does.
    (True, f"{CALLED}\ns when D then not B eventually", "causation B {m}"),
    (False, f"{CALLED}\ns when D then not B eventually", "causation B {m}\ncausation B (not {m})"),
    (True, f"{CALLED}\ns when D then not B within 5 minutes", "causation B {m}\ncausation B (not {m})"),
    (False, "k when A then B unless {m}\ns when D then not B eventually", "causation B {m}"),
    # What lasts may last still.
    (True, CALLED, "when B then {m} until C"),
    (True, CALLED, "when B then {m} until C\nincludes A {m}"),
    (False, CALLED, "when B then {m} until C\nforbid A {m}"),
    (False, CALLED, "when B then {m} until C\nincludes A {n}\nmeasure mutualExclusive {m} {n}"),
    # Other events of its instant, and of those before.
    (True, CALLED, "equal A B"),
    (False, f"{CALLED}\ns when D then not B eventually", "equal A B"),
    (False, f"{CALLED}\ns when D then not B eventually", "witness A B"),
    (True, f"{CALLED}\ns when D then not B eventually", "witness B A"),
    (True, CALLED, "mutualExclusive A B"),
    (False, CALLED, "happenBefore B A"),
]


@pytest.mark.parametrize(("expected", "rules", "relations"), LATE)
def test_after_all_else(expected, rules, relations):
    assert can_come_late(Program(parse(written(rules, relations))), "A") is expected


# Histories that a policy does not suit --------------------------------------------------------------------

A_SOON = Policy(soon=frozenset("A"))
UNSUITED = {
    "there is no time left": (
        ("r when B then A within 1 minute", "now when C then not A"),
        A_SOON,
        range(60, 61),
    ),
    "it is forbidden, and there is time left": (
        ("r when B then not A within 1 minute", "now when C then A within 10 seconds"),
        A_SOON,
        range(1, 51),
    ),
    "it is forbidden in the next second": (
        ("r when B then not A within [2, 2] seconds", "now when C then A within [1, 1] seconds"),
        Policy(soon=frozenset("A"), next=frozenset("A")),
        range(1, 2),
    ),
    "it is forbidden without end": (
        ("r when B then not A eventually", "now when C then A eventually"),
        Policy(late=frozenset("A")),
        range(1, 100),
    ),
    "it comes late, and has to be done by then": (
        ("r when B then not A within 1 minute", "now when C then A within 10 seconds"),
        Policy(late=frozenset("A")),
        range(1, 51),
    ),
    "it waits, and has to be done by then": (
        ("r when B then not A within 1 minute", "now when C then A within 10 seconds"),
        Policy(soon=frozenset("A"), waiting=frozenset("A")),
        range(1, 51),
    ),
    "it waits, and so does what it is done in place of": (
        (
            "r when B then not A within 1 minute",
            "r2 when B then not D within 1 minute",
            "now when C then A within 10 seconds otherwise D within 10 seconds",
        ),
        Policy(soon=frozenset("AD"), waiting=frozenset("AD")),
        range(1, 41),
    ),
    "it waits, and what is done in the next second calls for it": (
        (
            "r when B then not A within 1 minute",
            "s when D then A within 10 seconds",
            "now when C then D within 5 seconds",
        ),
        Policy(soon=frozenset("AD"), waiting=frozenset("A")),
        range(1, 46),
    ),
    "the second in which it is called for is forbidden": (
        ("r when B then not A within [1, 1] minutes", "now when C then A within [30, 30] seconds"),
        Policy(soon=frozenset("A"), first=frozenset("A")),
        range(30, 31),
    ),
    "the second in which it was called for is forbidden": (
        ("r when B then A within [1, 1] minutes", "now when C then not A within [30, 30] seconds"),
        Policy(soon=frozenset("A"), first=frozenset("A")),
        range(30, 31),
    ),
    "the next second, in which it was called for, is forbidden": (
        ("r when B then A within [20, 31] seconds", "now when C then not A within [0, 30] seconds"),
        Policy(soon=frozenset("A"), first=frozenset("A")),
        range(1, 32),
    ),
    "the next second, which was the one in which it was called for, is forbidden": (
        ("r when B then A within [1, 1] minutes", "now when C then not A within [1, 1] seconds"),
        Policy(soon=frozenset("A"), first=frozenset("A")),
        range(59, 60),
    ),
    "the last second in which it is called for is forbidden": (
        ("r when B then not A within [1, 1] minutes", "now when C then A within [30, 30] seconds"),
        Policy(soon=frozenset("A"), last=frozenset("A")),
        range(30, 31),
    ),
    "the last second in which it was called for is forbidden": (
        ("r when B then A within [1, 1] minutes", "now when C then not A within [30, 30] seconds"),
        Policy(soon=frozenset("A"), last=frozenset("A")),
        range(30, 31),
    ),
    "what lasts until something is done lasts still": (
        (
            "r when B then not E within 1 minutes",
            "now when C then A within [30, 30] seconds",
            "when B then {m} until E",
            "forbid A {m}",
        ),
        Policy(soon=frozenset("A"), over=frozenset({"the law"})),
        range(1, 30),
    ),
    "what lasts for some time lasts still": (
        ("now when C then A within [30, 30] seconds", "when B then {m} for 1 minutes", "forbid A {m}"),
        Policy(soon=frozenset("A"), over=frozenset({"the law"})),
        range(1, 30),
    ),
    "what has to come before has not come": (
        ("r when B then not D within 1 minute", "now when C then A within 10 seconds", "happenBefore D A"),
        A_SOON,
        range(1, 52),
    ),
}


@pytest.mark.parametrize(("rules", "policy", "times"), UNSUITED.values(), ids=UNSUITED.keys())
def test_a_history_that_a_policy_does_not_suit_is_found_all_the_same(rules, policy, times):
    is_rule = re.compile(r"\w+ when")
    relations = "\n".join(one for one in rules if not is_rule.match(one))
    program = Program(parse(written("\n".join(filter(is_rule.match, rules)), relations)))
    if policy.over:
        policy = policy._replace(over=frozenset(law_name(law) for law in program.laws if isinstance(law, Lasting)))
    rule = program.ruleset.by_label["now"]
    for since in {times[0], times[-1]}:
        search = Search(program, rule, Cone(program, rule), Tried(1))
        search.plans.defeat(Plan(frozenset(), policy=policy))
        (past,) = search.past
        # The one instant before now is so long ago, and what matters happens there.
        bounds = search.outer.times.bounds(past, search.now, since, since)
        for literal in (*bounds, search.outer.instants[past].event("B"), -search.outer.instants[search.now].event("B")):
            search.add([literal])
        history = search.find()
        assert history is not None
        assert history[1].time - history[0].time == since
