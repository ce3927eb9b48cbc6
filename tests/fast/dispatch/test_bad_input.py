"""What cannot be: each with a typed error that says what is wrong and what to do, and nothing executed or changed."""

# mypy: disable-error-code="arg-type, dict-item"

from __future__ import annotations

from collections.abc import Callable

import pytest

import sleec_runtime
from sleec_runtime import Monitor, Sensors, Sleec, errors
from sleec_runtime.model import Clause, Obligation, Rule, Ruleset
from sleec_runtime.predicates import Fuzzy, Scale, Threshold
from tests.support.robots import CURTAINS, Log, listing_2, running

TEXT = f"""
MEASURE UserAge: number
MEASURE Visitors: integer
MEASURE Risk: low < high
RULE age WHEN Visit THEN Greet UNLESS UserAge < 18 AND Visitors > 2 AND Risk = high IN WHICH CASE Ask
{CURTAINS}
"""


def later(sleec: Sleec) -> None:
    @sleec.rule("dress_assist")
    def request() -> None: ...

    sleec.bind(request)
    sleec.bind(request)


def on_a_property(sleec: Sleec) -> None:
    sleec.rule("age")(property(lambda self: None))


class Unmarked:
    def greet_not(self) -> None: ...


def bound_class(sleec: Sleec) -> None:
    class Robot:
        @sleec.rule("dress_assist")
        def request(self) -> None: ...

    sleec.bind(Robot)


Case = tuple[Callable[[Sleec], object], type[errors.SleecError], str]

CASES: dict[str, Case] = {
    "unknown condition": (
        lambda s: s.update({"UserUndresed": True}),
        errors.UnknownCondition,
        "did you mean `UserUndressed`",
    ),
    "trigger as condition": (lambda s: s.update({"Visit": True}), errors.UnknownCondition, "it is a trigger"),
    "far from any name": (lambda s: s.update({"qqqqqqqq": True}), errors.UnknownCondition, "the ruleset has "),
    "number for condition": (lambda s: s.update({"UserUndressed": 1}), errors.WrongType, "true or false"),
    "text for condition": (lambda s: s.update({"UserUndressed": "yes"}), errors.WrongType, "True or False"),
    "truth for number": (lambda s: s.update({"UserAge": True}), errors.WrongType, "a number"),
    "text for number": (lambda s: s.update({"UserAge": "18"}), errors.WrongType, "a number"),
    "no number": (lambda s: s.update({"UserAge": float("nan")}), errors.WrongType, "a number"),
    "infinite number": (lambda s: s.update({"UserAge": float("-inf")}), errors.WrongType, "a number"),
    "broken whole": (lambda s: s.update({"Visitors": 2.5}), errors.WrongType, "whole number"),
    "not on the scale": (lambda s: s.update({"Risk": "middle"}), errors.WrongType, "low < high"),
    "number for scale": (lambda s: s.update({"Risk": 1}), errors.WrongType, "low < high"),
    "unknown trigger": (lambda s: s.trigger("Visits"), errors.UnknownTrigger, "did you mean `Visit`"),
    "unknown trigger of several": (lambda s: s.trigger_all(["Visit", "X"]), errors.UnknownTrigger, "'X'"),
    "unknown trigger asked": (lambda s: s.due("Visits"), errors.UnknownTrigger, "did you mean `Visit`"),
    "unknown layer": (lambda s: s.layers["dress_assist.hc3"], errors.UnknownLayer, "dress_assist.hc"),
    "unknown label": (lambda s: s.rule("dress_asist"), errors.UnknownLabel, "did you mean `dress_assist`"),
    "unbind unknown": (lambda s: s.unbind("dres_assist"), errors.UnknownLabel, "did you mean `dress_assist`"),
    "unknown domain": (lambda s: s.enter_domain("moon"), errors.UnknownDomain, "has no domain"),
    "unknown obligation": (
        lambda s: s.implement({"OpenCurtain": print}),
        errors.UnknownObligation,
        "did you mean `OpenCurtains`",
    ),
    "not callable": (lambda s: s.implement({"OpenCurtains": "open"}), errors.Unbindable, "not callable"),
    "implements nothing": (lambda s: s.implement(Unmarked()), errors.Unbindable, "implements no obligation"),
    "nothing marked": (lambda s: s.bind(Unmarked()), errors.Unbindable, "mark methods"),
    "marked twice": (later, errors.AlreadyBound, "unbind('dress_assist') first"),
    "mark on a property": (on_a_property, errors.Unbindable, "cannot be the method"),
    "class without object": (bound_class, errors.Unbindable, "bind an instance"),
    "number for trigger": (lambda s: s.trigger(3), errors.UnknownTrigger, "give the name of a trigger"),
    "nothing for trigger": (lambda s: s.trigger(None), errors.UnknownTrigger, "give the name of a trigger"),
    "list for trigger": (lambda s: s.trigger(["Visit"]), errors.UnknownTrigger, "give the name of a trigger"),
    "list asked for": (lambda s: s.due(["Visit"]), errors.UnknownTrigger, "give the name of a trigger"),
    "number for layer": (lambda s: s.layers[3], errors.UnknownLayer, "give the name of a layer"),  # type: ignore[index]
    "list for layer": (lambda s: s.layers[[]], errors.UnknownLayer, "give the name of a layer"),  # type: ignore[index]
    "number for condition's name": (lambda s: s.update({1: True}), errors.UnknownCondition, "give the name"),
    "no changes": (lambda s: s.update(None), errors.WrongType, "give a dict"),
    "pairs for changes": (lambda s: s.update([("UserUndressed", True)]), errors.WrongType, "give a dict"),
    "no ruleset": (lambda s: s.replace(None), errors.WrongType, "parse(text)"),
    "no ruleset prepared": (lambda s: s.prepare(None), errors.WrongType, "parse(text)"),
    "text for ruleset": (lambda s: Sleec(TEXT), errors.WrongType, "parse(text)"),
    "name for triggers": (lambda s: s.trigger_all("Visit"), errors.WrongType, "give a list: ['Visit']"),
    "number for triggers": (lambda s: s.trigger_all(3), errors.WrongType, "give a list"),
    "unknown reading": (lambda s: Sleec(s.ruleset, reading="bogus"), errors.WrongType, "cascade or priority"),
    "unknown reading of a ruleset": (lambda s: s.ruleset.read_as("bogus"), errors.WrongType, "cascade or priority"),
    "unknown reading of a file": (
        lambda s: sleec_runtime.load("rulesets/household.sleec", reading="bogus"),
        errors.WrongType,
        "cascade or priority",
    ),
    "text for strict": (lambda s: Sleec(s.ruleset, strict="no"), errors.WrongType, "True or False"),
    "bounds that exclude all": (
        lambda s: Threshold("UserUndressed", "radar", at_least=3, at_most=1),
        errors.SleecError,
        "cannot be reached",
    ),
    "membership above 1": (
        lambda s: Sensors(s, Fuzzy("UserUndressed", "radar", lambda value: 2)).update({"radar": 1}),
        errors.WrongType,
        "from 0 to 1",
    ),
    "unknown sensor": (
        lambda s: Sensors(s, Threshold("UserUndressed", "radar", at_least=3)).update({"unknown": 3}),
        errors.SleecError,
        "Sensors(…) has radar",
    ),
    "no predicate": (lambda s: Sensors(s, "UserUndressed"), errors.WrongType, "give a Threshold"),
    "no name for the sensor": (
        lambda s: Sensors(s, Threshold("UserUndressed", ["radar"], at_least=3)),
        errors.WrongType,
        "the sensor of a predicate is a name",
    ),
    "no membership function": (
        lambda s: Sensors(s, Fuzzy("UserUndressed", "radar", 0.5)),
        errors.WrongType,
        "give a trapezoid(…)",
    ),
    "no list of cuts": (lambda s: Sensors(s, Scale("Risk", "radar", 3)), errors.WrongType, "give a list"),
    "no callback": (lambda s: Monitor(s, 5), errors.WrongType, "takes a Difference"),
    "list for label": (lambda s: s.rule(["dress_assist"]), errors.UnknownLabel, "give the name of a rule"),
    "list to unbind": (lambda s: s.unbind(["dress_assist"]), errors.UnknownLabel, "give the name of a rule"),
    "assumptions of an unknown trigger": (
        lambda s: s.broken_assumptions("Visits"),
        errors.UnknownTrigger,
        "did you mean `Visit`",
    ),
    "number for obligation": (lambda s: s.implement({5: print}), errors.UnknownObligation, "name of an obligation"),
    "no readings": (lambda s: Sensors(s).update(None), errors.WrongType, "give a dict"),
    "no method": (lambda s: s.trigger("Visit"), errors.NotBound, "implement() the obligations"),
}


@pytest.mark.parametrize("name", CASES)
def test_bad_input_is_refused_with_what_to_do(name: str) -> None:
    act, kind, words = CASES[name]
    sleec = running(TEXT)
    with pytest.raises(kind) as refusal:
        act(sleec)
    assert words in str(refusal.value)
    assert refusal.value.hint
    assert dict(sleec.conditions) == {}


def test_a_method_without_a_variant_does_not_run_its_base_instead() -> None:
    sleec = running(CURTAINS)

    class Robot(Log):
        @sleec.rule("dress_assist")
        def request(self) -> None:
            self.do("OpenCurtains")

    sleec.bind(robot := Robot())
    assert list(sleec.missing()) == ["dress_assist"]
    sleec.update({"UserUndressed": True})
    with pytest.raises(errors.NotBound, match=r"@cop.around\(sleec.layers\[.dress_assist.hc1.\]\)"):
        sleec.trigger("CurtainOpenRequest")
    assert robot.taken() == []


def test_every_error_is_one_to_catch() -> None:
    assert all(issubclass(kind, sleec_runtime.SleecError) for _, kind, _ in CASES.values())
    assert issubclass(errors.UnknownLayer, KeyError)


def test_a_label_names_one_rule() -> None:
    rule = Rule("r", "T", None, Clause(None, (Obligation("O"),)), ())
    with pytest.raises(errors.SleecError, match="two rules have the label 'r'"):
        Sleec(Ruleset((rule, rule)))


def test_a_file_that_cannot_be_read() -> None:
    with pytest.raises(errors.UnreadableFile):
        sleec_runtime.load("rulesets/no-such-file.sleec")


def test_a_domain_that_no_rule_has() -> None:
    with pytest.raises(errors.UnknownDomain, match="did you mean `household`"):
        sleec_runtime.load("rulesets/care-robot.sleec", domain="houshold")


def test_binding_is_all_or_nothing() -> None:
    sleec = running("RULE r1 WHEN a THEN o\nRULE r2 WHEN a THEN o")
    listing_2(first := running("RULE r1 WHEN a THEN o"))
    assert not first.missing()

    @sleec.rule("r1")
    def one() -> None: ...

    sleec.bind(one)

    class Twice:
        @sleec.rule("r2")
        def two(self) -> None: ...

        @sleec.rule("r2")
        def too(self) -> None: ...

    with pytest.raises(errors.AlreadyBound, match="rule `r2` already has the method `two`, and `too` is another"):
        sleec.bind(Twice())

    class Both:
        @sleec.rule("r2")
        def two(self) -> None: ...

        @sleec.rule("r1")
        def another(self) -> None: ...

    with pytest.raises(errors.AlreadyBound):
        sleec.bind(Both())
    sleec.unbind("r1")
    with pytest.raises(errors.AlreadyBound, match="one of them only"):
        sleec.bind(Both(), one)
    sleec.bind(one)
    assert list(sleec.missing()) == ["r2"]
