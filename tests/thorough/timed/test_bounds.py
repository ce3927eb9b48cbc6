"""Absurd values are refused at once, and no message grows with what it speaks of."""

# mypy: disable-error-code="arg-type, dict-item"

from __future__ import annotations

import math
import numbers
import threading
import time
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime import Monitor, MonotonicClock, Sensors, Sleec, VirtualClock, errors, obligation
from sleec_runtime.language import parse
from sleec_runtime.model import Context, Source, Span, exact
from sleec_runtime.monitor.difference import Difference
from sleec_runtime.predicates import Direct, Fuzzy, Scale, Threshold, trapezoid
from sleec_runtime.support.messages import LONGEST, represent, text_of
from sleec_runtime.timed.failures import Failure

RULES = """
MEASURE Age: number
MEASURE Visitors: integer
MEASURE Risk: low < high
MEASURE wait: integer
RULE a WHEN A THEN X UNLESS Age > 3 AND Visitors > 3 AND Risk = low AND Awake IN WHICH CASE Y
RULE b WHEN B THEN Y WITHIN wait seconds OTHERWISE X
RULE c WHEN C THEN NOT Y WITHIN wait seconds
"""

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


class Huge:
    def __repr__(self) -> str:
        return "x" * 10_000_000


class Failing:
    def __repr__(self) -> str:
        raise RuntimeError("no repr")


class Odd:
    """A real number that prints as `text`."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"Odd({self.text})"


numbers.Real.register(Odd)


def nested() -> list[object]:
    whole: list[object] = []
    for _ in range(100_000):
        whole = [whole]
    return whole


LONG_INT = 10**2_000_000

NUMBERS: dict[str, object] = {
    "a large Decimal": Decimal("1e10000000"),
    "a negative Decimal": Decimal("-1e10000000"),
    "a small Decimal": Decimal("1e-10000000"),
    "a Decimal of many digits": Decimal("1." + "1" * 1_000_000),
    "a Decimal of 1,400 digits": Decimal("1" * 700 + "." + "1" * 700),
    "another real number": Odd("1e10000000"),
    "a real number without digits": Odd("many"),
    "a Decimal that is not a number": Decimal("sNaN"),
    "an infinite Decimal": Decimal("Infinity"),
    "a large int": LONG_INT,
    "an int that Python does not print": 10**4_400,
    "a large Fraction": Fraction(LONG_INT),
    "a small Fraction": Fraction(1, LONG_INT),
    "no number": float("nan"),
    "infinity": float("inf"),
}

VALUES: dict[str, object] = {
    **NUMBERS,
    "a long text": "x" * 10_000_000,
    "long bytes": b"x" * 10_000_000,
    "a long repr": Huge(),
    "no repr": Failing(),
    "a deep list": nested(),
    "a list of large ints": [LONG_INT] * 1_000,
    "a large dict": dict.fromkeys(range(100_000), LONG_INT),
}


def updating(name: str) -> Callable[[Sleec, Any], object]:
    return lambda sleec, value: sleec.update({name: value})


ENTRIES: dict[str, Callable[[Sleec, Any], object]] = {
    **{f"update of {name}": updating(name) for name in ("Age", "Visitors", "Risk", "A")},
    "update of a condition": lambda s, v: s.update({"Awake": v}),
    "changes": lambda s, v: s.update(v),
    "name of a trigger": lambda s, v: s.trigger(v),
    "names of triggers": lambda s, v: s.trigger_all(v),
    "one of several triggers": lambda s, v: s.trigger_all(["A", v]),
    "what is asked": lambda s, v: s.due(v),
    "what is done": lambda s, v: s.completed(v),
    "code": lambda s, v: s.implement({"X": v}),
    "object with code": lambda s, v: s.implement(v),
    "object with methods": lambda s, v: s.bind(v),
    "label": lambda s, v: s.rule(v),
    "label to unbind": lambda s, v: s.unbind(v),
    "layer": lambda s, v: s.layers[v],
    "domain": lambda s, v: s.enter_domain(v),
    "rules": lambda s, v: s.replace(v),
    "choice": lambda s, v: Sleec(s.ruleset, strict=v),
    "reading": lambda s, v: Sleec(s.ruleset, reading=v),
    "clock": lambda s, v: Sleec(s.ruleset, clock=v),
    "start of a clock": lambda s, v: VirtualClock(v),
    "time that passes": lambda s, v: VirtualClock().advance(v),
    "threshold": lambda s, v: Threshold("Awake", "radar", at_least=v),
    "cuts": lambda s, v: Sensors(s, Scale("Risk", "radar", cuts=[v])),
    "membership": lambda s, v: Sensors(s, Fuzzy("Awake", "radar", lambda _: v)).update({"radar": 1}),
    "corner": lambda s, v: trapezoid(v, 1, 2, 3),
    "reading of a sensor": lambda s, v: Sensors(s, Direct("Age", "radar")).update({"radar": v}),
    "readings of sensors": lambda s, v: Sensors(s, Direct("Age", "radar")).update(v),
    "condition of a predicate": lambda s, v: Sensors(s, Direct(v, "radar")),
    "callback": lambda s, v: Monitor(s, v),
}


@pytest.fixture
def sleec() -> Sleec:
    sleec = Sleec(parse(RULES), clock=VirtualClock())
    sleec.implement({"X": lambda: None, "Y": lambda: None})
    return sleec


@pytest.mark.parametrize("entry", ENTRIES)
def test_absurd_values_are_refused_at_once_in_a_few_words(entry: str, sleec: Sleec) -> None:
    for name, value in VALUES.items():
        began = time.process_time()
        with pytest.raises(errors.SleecError) as refusal:
            ENTRIES[entry](sleec, value)
        assert time.process_time() - began < 2, name
        assert len(str(refusal.value)) < 1_000, name
        assert dict(sleec.conditions) == {}


def test_a_change_of_absurd_values_changes_nothing(sleec: Sleec) -> None:
    for value in NUMBERS.values():
        with pytest.raises(errors.WrongType, match="Age is a measure, a number of at most 1,000 digits"):
            sleec.update({"Awake": True, "Age": value})
    assert dict(sleec.conditions) == {}


@pytest.mark.parametrize(
    "value",
    [
        0,
        Odd("2.5"),
        10**999,
        -(10**999),
        5e-324,
        1.7976931348623157e308,
        Decimal("1e-900"),
        Decimal(0),
        Fraction(10**999, 7),
        1e22,
    ],
)
def test_numbers_of_up_to_a_thousand_digits_are_exact(value: Any, sleec: Sleec) -> None:
    sleec.update({"Age": value})
    known = Fraction(sleec.conditions["Age"])
    assert known == Fraction(str(value))
    assert sleec.due("A").obligations == ("X",)


@given(st.one_of(st.floats(), st.decimals(), st.fractions(), st.integers(), st.decimals(places=1_500)))
def test_what_is_exact_once_stays_so(value: Any) -> None:
    number = exact(value)
    if number is not None:
        assert exact(number) == number
        assert Fraction(str(value)) == number


# Clocks and windows ---------------------------------------------------------------------------------------


class Shows:
    """A clock that shows what it is given."""

    def __init__(self, time: object) -> None:
        self.time = time

    def now(self) -> Any:
        return self.time

    def wake(self, at: object, call: Callable[[], object]) -> Callable[[], None]:
        return lambda: None


NO_TIMES: dict[str, object] = {
    **VALUES,
    "a late time": 10**12 + 1,
    "a late float": 1e300,
    "true": True,
    "nothing": None,
}


@pytest.mark.parametrize("name", NO_TIMES)
def test_a_clock_that_shows_no_time_is_refused_before_anything_changes(name: str) -> None:
    began = time.process_time()
    with pytest.raises(errors.WrongType, match="the time of the clock is a number of seconds"):
        Sleec(parse(RULES), clock=Shows(NO_TIMES[name]))
    clock = Shows(0)
    sleec = Sleec(parse(RULES), clock=clock)
    done: list[str] = []
    sleec.implement({"X": lambda: done.append("X"), "Y": lambda: done.append("Y")})
    sleec.update({"wait": 5})
    clock.time = NO_TIMES[name]
    for act in (lambda: sleec.trigger("B"), sleec.pending, lambda: sleec.completed("Y"), lambda: sleec.due("B")):
        with pytest.raises(errors.WrongType, match="the time of the clock is a number of seconds") as refusal:
            act()
        assert len(str(refusal.value)) < 1_000
    clock.time = 1
    assert done == []
    assert sleec.pending() == ()
    assert time.process_time() - began < 2


@pytest.mark.parametrize("now", [Decimal("1.5"), Fraction(3, 2), 1.5])
def test_a_clock_may_show_any_kind_of_number(now: object) -> None:
    sleec = Sleec(parse(RULES), clock=Shows(now))
    sleec.implement({"Y": obligation("Y", completes=False)(lambda: None), "X": lambda: None})
    sleec.update({"wait": 3})
    (due,) = sleec.trigger("B").due
    assert (due.start, due.until) == (1.5, 4.5)


@pytest.mark.parametrize("wait", [10**12 + 1, 10**400, 10**999, -1, -(10**400)])
@pytest.mark.parametrize("clock", [VirtualClock, lambda: Shows(0.5), lambda: None])
def test_a_window_of_absurd_length_is_refused_before_anything_changes(wait: int, clock: Callable[[], Any]) -> None:
    with Sleec(parse(RULES), clock=clock()) as sleec:
        sleec.implement({"X": lambda: None, "Y": lambda: None})
        sleec.update({"wait": wait})
        for trigger in "BC":
            with pytest.raises(errors.WrongType, match="wait seconds is the length of a window") as refusal:
                sleec.trigger(trigger)
            assert len(str(refusal.value)) < 1_000
        assert sleec.pending() == ()


# Messages -------------------------------------------------------------------------------------------------


def test_many_prohibitions_are_counted(sleec: Sleec) -> None:
    sleec.update({"wait": 60})
    for _ in range(1_000):
        sleec.trigger("C")
    with pytest.raises(errors.Prohibited, match="and 995 more") as refusal:
        sleec.trigger("B")
    assert len(str(refusal.value)) < 500
    assert refusal.value.message.count("forbids it") == 5


def error_classes(base: type[errors.SleecError] = errors.SleecError) -> list[type[errors.SleecError]]:
    return [base, *(found for one in base.__subclasses__() for found in error_classes(one))]


@pytest.mark.parametrize("kind", sorted(error_classes(), key=str))
def test_the_message_and_the_hint_of_every_error_are_bounded(kind: type[errors.SleecError]) -> None:
    for letter in ("m", "\x1b", "\u202e"):
        error = kind.__new__(kind)
        errors.SleecError.__init__(error, letter * 1_000_000, letter * 1_000_000)
        assert (len(error.message), len(error.hint or "")) == (LONGEST, LONGEST)
        if kind.sentences is errors.SleecError.sentences:
            assert len(str(error)) <= 2 * LONGEST


LISTS: dict[str, Callable[[], object]] = {
    "unknown among many": lambda: errors.UnknownTrigger("zzzzzzzz", [f"Trigger{n}" for n in range(100_000)]),
    "many unreported": lambda: errors.UndeterminedDecision(["A"], [f"c{n}" for n in range(100_000)]),
    "many errors": lambda: errors.VariantsFailed([(f"r{n}", OSError("x" * 10_000)) for n in range(1_000)]),
    "errors without repr": lambda: errors.VariantsFailed([("r", NoWords()) for n in range(1_000)]),
    "many problems": lambda: errors.CertificateRefused([("no", "x" * 100)] * 100_000),
    "many problems of a text": lambda: errors.LanguageError(
        Source("x.sleec", ""), [errors.Problem("\x1b" * 100, Span(0, 0), "h" * 100)] * 10_000
    ),
    "a failure": lambda: Failure(1, "r", tuple(f"O{n}" for n in range(100_000)), OSError("x" * 1_000_000)),
    "a failure without words": lambda: Failure(1, "r", ("O",), NoWords()),
    "a difference": lambda: difference([f"O{n}" for n in range(100_000)]),
}


class NoWords(Exception):
    def __str__(self) -> str:
        raise RuntimeError("no words")

    __repr__ = __str__


def difference(names: list[str]) -> Difference:
    return Difference(Context(frozenset({"A"}), {}), tuple(names), (), tuple(names), (), ())


@pytest.mark.parametrize("name", LISTS)
def test_lists_in_messages_are_cut(name: str) -> None:
    assert len(str(LISTS[name]())) <= 2 * LONGEST


def test_defaults_of_code_do_not_grow_a_message(sleec: Sleec) -> None:
    for default in VALUES.values():

        def code(one: object = default) -> None: ...

        sleec.implement({"X": code})
        with pytest.raises(errors.WrongArguments) as refusal:
            sleec.trigger("A", 1, 2, 3)
        assert len(str(refusal.value)) < LONGEST + 500


def test_an_error_without_words_does_not_end_the_thread_of_a_clock() -> None:
    def fail() -> None:
        raise NoWords

    clock = MonotonicClock()
    called = threading.Event()
    clock.wake(clock.now() + 1_000, called.set)
    clock.wake(clock.now(), fail)
    clock.wake(clock.now() + 0.01, called.set)
    assert called.wait(60)
    clock.close()


def test_an_object_without_attributes_has_a_representation() -> None:
    class Closed:
        def __getattr__(self, name: str) -> object:
            raise RuntimeError(name)

    assert represent(Closed()) == "<Closed object>"


def test_representations_of_what_is_short_are_those_of_python() -> None:
    for value in (
        1,
        -5,
        2.5,
        "ab",
        b"ab",
        None,
        True,
        [1, "a"],
        {"a": 1},
        (1,),
        Fraction(1, 3),
        Decimal("1.5"),
        math.pi,
    ):
        assert represent(value) == repr(value)
        assert text_of(value) == str(value)
