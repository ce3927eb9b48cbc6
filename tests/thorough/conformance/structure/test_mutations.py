"""Correct robots for random rules are accepted; one mistake in them is reported for what it is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from sleec_runtime.model import Ruleset
from tests.support.robot_sources import Robot, Written, robots
from tests.support.strategies import rulesets
from tests.support.structure import kinds


@st.composite
def correct(draw: st.DrawFn) -> Robot:
    ruleset: Ruleset = draw(
        rulesets(max_rules=3, max_depth=0, constraints=False, measures=False, domains=False, declarations=False)
    )
    for rule in ruleset.rules:
        for clause in rule.clauses():
            # What is due twice may be done once or twice, and what is due and prohibited cannot be done right.
            assume(len({literal.name for literal in clause.obligations}) == len(clause.obligations))
    robot: Robot = draw(robots(ruleset))
    return robot


def variants(robot: Robot) -> Iterator[tuple[str, Written]]:
    for label, written in robot.methods.items():
        for one in written:
            yield label, one


def pick(draw: st.DrawFn, robot: Robot, wanted: Callable[[Written], bool]) -> tuple[str, Written]:
    candidates = [(label, written) for label, written in variants(robot) if wanted(written)]
    assume(candidates)
    return draw(st.sampled_from(candidates))


def drop_a_call(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: bool(w.calls))
    del written.calls[draw(st.integers(0, len(written.calls) - 1))]
    return {"missing-obligation"}


def swap_two_calls(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: len(w.calls) > 1)
    at = draw(st.integers(0, len(written.calls) - 2))
    written.calls[at : at + 2] = written.calls[at : at + 2][::-1]
    return {"obligation-order"}


def swap_two_layers(draw: st.DrawFn, robot: Robot) -> set[str]:
    pairs = [
        (one, other)
        for written in robot.methods.values()
        for one in written
        for other in written
        if one.calls != other.calls and one.calls and None not in (one.layer, other.layer)
    ]
    assume(pairs)
    one, other = draw(st.sampled_from(pairs))
    one.layer, other.layer = other.layer, one.layer
    return {"wrong-layer"}


def mistype_a_layer(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: w.layer is not None)
    assert written.layer is not None
    written.layer = written.layer.replace(".hc", "x.hc")
    return {"unknown-layer"}


def take_a_layer_of_another_rule(draw: st.DrawFn, robot: Robot) -> set[str]:
    label, written = pick(draw, robot, lambda w: w.layer is not None)
    others = [w.layer for other, w in variants(robot) if other != label and w.layer is not None]
    assume(others)
    written.layer = draw(st.sampled_from(others))
    return {"foreign-layer"}


def forget_a_layer(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: w.layer is not None)
    around = {0: "cop.around", 1: "contextpy3.around", 2: "when", 3: "around"}[robot.imports]
    written.decorator = f"{around}()"
    return {"no-layer"}


def add_a_call(draw: st.DrawFn, robot: Robot) -> set[str]:
    assume(robot.ruleset.obligations)
    _, written = pick(draw, robot, lambda w: True)
    written.calls.append(draw(st.sampled_from(sorted(robot.ruleset.obligations))))
    return {"extra-obligation", "prohibited-obligation"}


def remove_a_variant(draw: st.DrawFn, robot: Robot) -> set[str]:
    label, written = pick(draw, robot, lambda w: bool(w.calls))
    robot.methods[label] = [w for w in robot.methods[label] if w is not written]
    if not robot.methods[label]:
        return {"missing-method"}
    return {"missing-base"} if written.layer is None else {"missing-variant"}


def duplicate_a_variant(draw: st.DrawFn, robot: Robot) -> set[str]:
    label, written = pick(draw, robot, lambda w: True)
    robot.methods[label] = [*robot.methods[label], Written(written.layer, list(written.calls))]
    return {"duplicate-variant", "lost-variant"}


def add_proceed(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: True)
    written.lines.append(f"{robot.proceed}(*args)")
    return {"proceed"}


def call_conditionally(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: bool(w.calls))
    call = robot.call(written.calls.pop())
    written.lines.append(
        draw(st.sampled_from(["if args: {}", "for _ in args: {}", "args and {}", "lambda: {}"])).format(call)
    )
    return {"conditional-obligation"}


def call_after_return(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: bool(w.calls))
    written.lines += ["return", robot.call(written.calls.pop())]
    return {"conditional-obligation"}


def guard_a_variant(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: w.layer is not None)
    around = {0: "cop.around", 1: "contextpy3.around", 2: "when", 3: "around"}[robot.imports]
    written.decorator = f"{around}(sleec.layers[{written.layer!r}], guard=print)"
    return {"guarded-variant"}


def compute_a_layer(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: w.layer is not None)
    around = {0: "cop.around", 1: "contextpy3.around", 2: "when", 3: "around"}[robot.imports]
    written.decorator = f"{around}(sleec.layers[input()])"
    return {"undecided"}


def execute_around_the_dispatch(draw: st.DrawFn, robot: Robot) -> set[str]:
    _, written = pick(draw, robot, lambda w: bool(w.calls))
    robot.more = f"def on_button({'' if robot.module_level else 'self'}): {robot.call(written.calls[0])}"
    return {"obligation-around"}


def call_the_method(draw: st.DrawFn, robot: Robot) -> set[str]:
    place = draw(st.integers(0, len(robot.methods) - 1))
    robot.more = f"def on_button({'' if robot.module_level else 'self'}): "
    robot.more += f"{'' if robot.module_level else 'self.'}rule_{place}()"
    return {"method-around"}


MISTAKES = (
    drop_a_call, swap_two_calls, swap_two_layers, mistype_a_layer, take_a_layer_of_another_rule, forget_a_layer,
    add_a_call, remove_a_variant, duplicate_a_variant, add_proceed, call_conditionally, call_after_return,
    guard_a_variant, compute_a_layer, execute_around_the_dispatch, call_the_method,
)  # fmt: skip


@settings(max_examples=40)
@given(correct())
def test_correct_robots_are_accepted(robot: Robot) -> None:
    assert kinds(robot.ruleset, robot=robot.text()) == []


@pytest.mark.slow
@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.__name__)
@settings(max_examples=15, suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])
@given(data=st.data())
def test_a_mistake_is_reported_for_what_it_is(mistake: Callable[[Any, Robot], set[str]], data: st.DataObject) -> None:
    robot = data.draw(correct())
    expected = mistake(data.draw, robot)
    found = set(kinds(robot.ruleset, robot=robot.text()))
    assert found & expected, robot.text()
