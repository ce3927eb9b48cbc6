"""Scenarios in files of cases: what is read, and one message for each mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from sleec_runtime.language import parse
from sleec_verify.conformance.cases.case import Case, CasesError
from sleec_verify.conformance.cases.reader import CaseFile, read_cases
from sleec_verify.conformance.scenarios.scenario import Completion, Step
from sleec_verify.results.timeline import Due

RULES = parse("""
MEASURE Age: number
RULE fall
WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 2 minutes
UNLESS Age < 18 IN WHICH CASE CallParents AND NOT Vacuum WITHIN 1 hour
RULE dust
WHEN DustSeen THEN Vacuum WITHIN 1 day
""")

CASE = '[[case]]\nname = "a"\n'
STEPS = 'steps = [{ at = 0, when = ["UserFell"] }]\n'
DUE = 'obligations = [{ name = "CallNurse", from = 0, to = 300 }]\n'


def read(text: str, folder: Path, rules: object = RULES) -> CaseFile:
    path = folder / "a.cases.toml"
    path.write_text(text, encoding="utf-8")
    return read_cases(path, rules)  # type: ignore[arg-type]


def test_a_scenario(tmp_path: Path) -> None:
    text = """
    [[case]]
    name = "nobody comes"
    steps = [
      { at = 0, when = ["UserFell"], given = { Age = 80 } },
      { at = "2 minutes", given = { Age = 81 } },
    ]
    end = "1 hour"
    completions = [{ name = "CallNurse", since = 0, at = "never" }]
    obligations = [
      { name = "CallNurse", from = 0, to = "5 minutes", rule = "fall" },
      { name = "CallAmbulance", from = 300, to = 420, rule = "fall", instead_of = "CallNurse", overdue = true },
    ]
    prohibitions = [{ name = "Vacuum", from = 0, rule = "fall.hc1" }]
    reaches = ["fall (default)"]
    """
    (found,) = read(text, tmp_path).scenarios
    assert (found.name, found.end) == ("nobody comes", 3600)
    assert found.reaches == ("fall (default)",)
    assert found.steps == (Step(0, ("UserFell",), {"Age": 80}), Step(120, (), {"Age": 81}))
    assert found.completions == (Completion("CallNurse", 0, None),)
    assert found.obligations == (
        Due("fall", 0, "CallNurse", "CallNurse", False, 0, 300),
        Due("fall", 0, "CallAmbulance", "CallAmbulance", False, 300, 420, "CallNurse", True),
    )
    assert found.prohibitions == (Due("fall", 1, "NOT Vacuum", "Vacuum", True, 0, None),)


def test_cases_with_and_without_steps_in_one_file(tmp_path: Path) -> None:
    found = read(CASE + STEPS + DUE + '[[case]]\nwhen = ["DustSeen"]\nobligations = ["Vacuum"]', tmp_path)
    assert found.situations == (Case("case 2", ("DustSeen",), {}, ("Vacuum",)),)
    assert found.scenarios[0].end == 300, "to the end of the last window"


def completing(rest: str) -> str:
    return CASE + STEPS + DUE + f"completions = [{rest}]"


def step(rest: str) -> str:
    return CASE + f"steps = [{{ at = 5 }}, {{ {rest} }}]\nobligations = []"


def due(rest: str) -> str:
    return CASE + STEPS + f"obligations = [{{ {rest} }}]"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (CASE + STEPS + DUE + "until = 3", "unknown key 'until'"),
        (CASE + STEPS + DUE + 'when = ["UserFell"]', "unknown key 'when'"),
        (CASE + STEPS.replace("steps", "step") + DUE, "unknown key 'step' .did you mean `steps`"),
        (CASE + STEPS, "does not say what is required"),
        (CASE + "steps = 3\nobligations = []", "steps is not a list of tables"),
        (CASE + "steps = []\nobligations = []", "steps is empty"),
        (step("when = []"), "step 2: the key `at` is missing"),
        (step("at = 6, whe = []"), "step 2 has an unknown key 'whe' .did you mean `when`"),
        (step("at = -1"), "step 2: at is -1, before the start"),
        (step("at = 1000000000001"), "step 2: at is 1000000000001, too long"),
        (step('at = "300000000 days"'), "too long"),
        (step("at = 1.5"), "not a time .give whole seconds"),
        (step('at = "5 fortnights"'), "step 2: at is '5 fortnights', not a time"),
        (step("at = true"), "not a time"),
        (step("at = 5"), "step 2: the time 5 occurs twice"),
        (step("at = 4"), "step 2: the time 4 is before that of the previous step, 5"),
        (step('at = 6, when = ["UserFel"]'), "step 2: no trigger is called `UserFel` .did you mean `UserFell`"),
        (step('at = 6, given = { Age = "old" }'), "step 2: `Age` must be a number"),
        (due('name = "CallNurse"'), "obligation 1: the key `from` is missing"),
        (due('name = "CallNurs", from = 0'), "obligation 1: no obligation is called `CallNurs`"),
        (due('name = "CallNurse", from = -3'), "obligation 1: from is -3, before the start"),
        (due('name = "CallNurse", from = 9, to = 3'), "the window ends at 3, before it starts at 9"),
        (due('name = "CallNurse", from = 0, to = 1000000000001'), "obligation 1: to is 1000000000001, too long"),
        (due('name = "CallNurse", from = 0, rule = "fell"'), "no rule is called `fell` .did you mean `fall`"),
        (due('name = "CallNurse", from = 0, rule = "fall.hc2"'), r"no rule is called `fall.hc2`"),
        (due('name = "CallNurse", from = 0, overdue = 1'), "overdue must be true or false"),
        (CASE + STEPS + DUE + "end = -1", "end is -1, before the start"),
        (CASE + "steps = [{ at = 9 }]\nobligations = []\nend = 8", "the end is 8, before the step at 9"),
        (completing('{ name = "CallNurse", since = 0, at = 60 }') + "\nend = 59", "before the completion at 60"),
        (completing('{ name = "CallNurse", since = 0 }'), "completion 1: the key `at` is missing"),
        (completing('{ name = "CallNurse", since = 1, at = 2 }'), "`CallNurse` is not due from 1 on .it is due from 0"),
        (completing('{ name = "Vacuum", since = 0, at = 2 }'), "`Vacuum` is not due from 0 on .add it to obligations"),
        (completing('{ name = "CallNurse", since = 0, at = 301 }'), "after the window ends at 300"),
        (completing('{ name = "CallNurse", since = 0, at = 1 }, ' * 2), "`CallNurse` since 0 is completed twice"),
        (CASE + STEPS + DUE + CASE + "steps = [{ at = 3 }]\nobligations = []", "cases 1 and 2 have the same name"),
        (
            CASE + STEPS + DUE + CASE.replace('"a"', '"b"') + STEPS + DUE,
            "cases 1 and 2 have the same steps and completions",
        ),
        (
            CASE + STEPS + DUE + '[[case]]\nwhen = "UserFell"\nobligations = []',
            "cases 1 and 2 have the same steps and completions",
        ),
        ('sha256 = "00"\n' + CASE + STEPS + DUE, "the cases are for another version of <memory>"),
    ],
)
def test_bad_scenarios(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(CasesError, match=message) as caught:
        read(text, tmp_path)
    assert "a.cases.toml" in str(caught.value)


def test_a_completion_before_its_window(tmp_path: Path) -> None:
    text = CASE + STEPS + 'obligations = [{ name = "CallNurse", from = 9, to = 99 }]\n'
    with pytest.raises(CasesError, match="completed at 8, before it is due at 9"):
        read(text + 'completions = [{ name = "CallNurse", since = 9, at = 8 }]', tmp_path)


def test_steps_need_rules_with_time(tmp_path: Path) -> None:
    rules = parse("RULE a WHEN UserFell THEN CallNurse")
    with pytest.raises(CasesError, match="the case has steps, but the rules have no times"):
        read(CASE + STEPS + DUE, tmp_path, rules)
