"""How often names are reported: never for neutral words, always for each kind of mistake, rarely in real rulesets."""

from __future__ import annotations

from collections.abc import Callable

from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load
from sleec_verify.checks import run_checks
from sleec_verify.checks.misread_names import MISREAD_NAME
from sleec_verify.encoding.name_uses import names_used
from sleec_verify.files.toml import read_toml
from tests.support.misread import COMPARISON, KEYWORD, MODAL, NEGATION, OPPOSITES, SIMILAR, SLIP, codes
from tests.support.paths import ROOT
from tests.support.studies import OWN, published_files

VERBS = ("bring", "clean", "fetch", "follow", "greet", "guide", "hold", "lift", "paint", "repair", "touch", "wash")
NOUNS = ("basket", "blanket", "camera", "chair", "garden", "kitchen", "lamp", "medicine", "pillow", "robot", "visitor")
STATES = ("blue", "calm", "damp", "fragile", "hungry", "lost", "noisy", "tired", "warm")

VERB, NOUN, STATE = map(st.sampled_from, (VERBS, NOUNS, STATES))
ACTIONS = st.builds("{} the {}".format, VERB, NOUN)
FACTS = st.builds("the {} is {}".format, NOUN, STATE)
EVENTS = st.builds("the {} arrives".format, NOUN)


@st.composite
def neutral_rules(draw: st.DrawFn) -> str:
    """Rules of neutral words: no name of them says more than it is."""
    rules = draw(st.lists(st.tuples(EVENTS, ACTIONS, FACTS, ACTIONS), min_size=1, max_size=8))
    return "".join(f"WHEN {a} THEN {b}\nUNLESS {c} IN WHICH CASE {d}\n" for a, b, c, d in rules)


@given(neutral_rules())
def test_neutral_words_have_no_finding(text: str) -> None:
    assert not codes(text)


def obligation(words: str) -> str:
    return f"WHEN the planted bell rings THEN {words}\n"


def conditions(one: str, other: str) -> str:
    return f"WHEN the planted bell rings THEN hum UNLESS {one} IN WHICH CASE whistle UNLESS {other}\n"


@st.composite
def planted(draw: st.DrawFn) -> tuple[str, str]:
    """A rule with one mistake, and the code of its finding."""
    verb, noun, state = draw(VERB), draw(NOUN.filter(lambda noun: len(noun) > 4)), draw(STATE)
    action = f"{verb} the {noun}"
    letter = draw(st.integers(1, 3))
    number = draw(st.integers(2, 99))
    actions = obligation(action)
    kinds: dict[str, list[Callable[[], str]]] = {
        NEGATION: [
            lambda: obligation(f"the {draw(st.sampled_from(['robot', 'system']))} is not allowed to {action}"),
            lambda: obligation(f"not {action}"),
        ],
        MODAL: [
            lambda: obligation(f"{draw(st.sampled_from(['it has to', 'the robot needs to', 'you shall']))} {action}"),
        ],
        COMPARISON: [
            lambda: conditions(
                f"the {noun} weight is {draw(st.sampled_from(['under', 'at least', 'more than']))} {number}", "it snows"
            ),
            lambda: conditions(f"there are {number} {noun}s", "it snows"),
        ],
        OPPOSITES: [
            lambda: conditions(f"the {noun} is open", f"the {noun} is closed"),
            lambda: conditions(f"the {noun} is packed", f"the {noun} is unpacked"),
        ],
        KEYWORD: [
            lambda: obligation(f"{action} {draw(st.sampled_from(['IMMEDIATELY', 'NOW', 'ASAP']))}"),
            lambda: obligation(f"BUT {action}"),
            lambda: conditions(f"the {noun} is {state} IMPLIES it snows", "it rains"),
        ],
        SIMILAR: [
            lambda: actions + obligation(action.replace(" the ", " ")),
            lambda: actions + obligation(action.capitalize()),
            lambda: actions + obligation(f"{action}s"),
        ],
        SLIP: [
            lambda: actions * 2 + obligation(f"{verb} the {noun[:letter]}{noun[letter + 1 :]}"),
            lambda: actions * 2 + obligation(f"{verb} the {noun[:letter]}x{noun[letter:]}"),
        ],
    }
    code = draw(st.sampled_from(sorted(kinds)))
    return draw(st.sampled_from(kinds[code]))(), code


@given(planted(), neutral_rules())
def test_a_planted_mistake_has_its_finding(mistake: tuple[str, str], others: str) -> None:
    text, code = mistake
    assert code in codes(text)
    assert code in codes(others + text)


def test_findings_are_rare_in_real_rulesets() -> None:
    """At most 2 % of the names of shipped and published rulesets, besides those that a study has on purpose."""
    expected = read_toml(OWN / "expected.toml", "expected.toml", SleecError)
    kinds = {kind.code for kind in MISREAD_NAME.kinds}
    names = findings = 0
    for path in (*ROOT.glob("rulesets/**/*.sleec"), *ROOT.glob("examples/**/*.sleec"), *published_files()):
        ruleset = load(path)
        used = names_used(ruleset)
        names += len(used["condition"] | used["event"])
        (result,) = run_checks(ruleset, [MISREAD_NAME.name])
        on_purpose = sum(len(expected.get(path.name, {}).get(code, ())) for code in kinds)
        findings += len(result.findings) - on_purpose
    assert names > 500
    assert 0 <= findings <= 0.02 * names
