"""What does not take calculations refuses them, and what finds values for them."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.errors import UnsupportedCalculations
from sleec_runtime.language import parse
from sleec_runtime.model import Calculation
from sleec_verify.changes.compare import compare
from sleec_verify.cli import run
from sleec_verify.conformance.regions import givens
from sleec_verify.encoding.arithmetic import NotCalculated
from sleec_verify.encoding.calculations import calculations_in
from sleec_verify.exchange.compilation import EQUATION_FORMS, compile_to
from sleec_verify.results.finding import Unknown
from tests.support.calculations import BOTH, NAMES, NEEDS_Z3, TEXT, guard_of, results, ruleset_of


@pytest.mark.parametrize("form", EQUATION_FORMS)
def test_no_form_of_equation_1_takes_them(form):
    with pytest.raises(UnsupportedCalculations, match=r"`x \+ y` in line 11, `x \* y` in line 12") as caught:
        compile_to(ruleset_of(*BOTH), form)
    assert caught.value.lines == (11, 12)


@pytest.mark.parametrize(("to", "language"), [("english", "structured English"), ("dsl", "SLEEC-TK")])
def test_what_cannot_say_them_refuses_with_the_place(to, language, tmp_path, capsys):
    path = tmp_path / "rules.sleec"
    path.write_text(TEXT % ("\n".join(BOTH), ""))
    assert run(["convert", str(path), "--to", to]) == 2
    said = capsys.readouterr().err
    assert f"rules.sleec:11: {language} has no calculations such as `x + y`" in said
    assert "help: " in said


def test_legos_says_them(tmp_path, capsys):
    path = tmp_path / "rules.sleec"
    path.write_text(TEXT % ("\n".join(BOTH), ""))
    assert run(["convert", str(path), "--to", "legos"]) == 0
    assert parse(capsys.readouterr().out).rules == ruleset_of(*BOTH).rules


def test_comparing_rulesets_says_that_they_are_not_compared():
    one, other = ruleset_of(*BOTH), ruleset_of(BOTH[0])
    assert not compare(one, one).undecided
    (undecided,) = compare(one, other).undecided
    assert "`x + y` in line 11" in undecided.what


def test_games_say_that_they_do_not_calculate():
    (verdict,) = results(*BOTH, only=["realizability"]).values()
    assert isinstance(verdict, Unknown)
    assert "games with calculations are not supported: `x + y` in line 11" in verdict.why


def test_a_test_of_every_context_refuses():
    (rule, _) = ruleset_of(*BOTH).rules
    with pytest.raises(UnsupportedCalculations):
        givens([rule.guard], ruleset_of(*BOTH).measures)


def test_a_certificate_does_not_rest_on_z3(tmp_path, capsys):
    path = tmp_path / "rules.sleec"
    path.write_text(TEXT % ("\n".join(NEEDS_Z3), ""))
    assert run(["certify", str(path), "-o", str(tmp_path / "certificate")]) == 3
    manifest = (tmp_path / "certificate" / "manifest.json").read_text()
    assert "which a certificate cannot prove" in manifest
    # What regions alone refute is proved as ever.
    path.write_text(TEXT % ("R1 when A and ({x} + {y} < 3) then B\nR2 when A and ({x} + {y} > 5) then not B", ""))
    capsys.readouterr()
    assert run(["certify", str(path), "-o", str(tmp_path / "other")]) == 0
    assert "conflict            proved    1 question refuted" in capsys.readouterr().out
    assert run(["certify", "--check", str(tmp_path / "other"), str(path)]) == 0


def test_arithmetic_tells_what_contradicts_what():
    pytest.importorskip("z3")
    from sleec_verify.encoding.arithmetic import values_for

    (calculated,) = calculations_in(guard_of("(({x} + (2 * {y})) > 3)"))
    whole = {"x": True, "y": True}
    cuts = [("x", 1, True, 4), ("y", 1, True, 5), ("x", -9, True, -6)]
    assert sorted(values_for(whole, cuts, [], [(calculated, 3, True, -7)])) == [-7, 4, 5]
    found = values_for(whole, cuts, [("y", "x", 8)], [(calculated, 2, True, -7)])
    assert found == {"x": 1, "y": 1}
    found = values_for(whole, cuts, [("x", "y", -8)], [(calculated, 2, True, 7)])
    assert isinstance(found, dict)
    assert found["y"] < found["x"] <= 1
    halves = values_for(
        {"x": True, "y": False},
        [("x", 0, True, 1), ("x", 0, False, -2)],
        [],
        [(calculated, 3, True, 3), (calculated, 3, False, -4)],
    )
    assert isinstance(halves, dict)
    assert halves["x"] + 2 * halves["y"] == 3


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_what_is_found_nearby_makes_all_literals_true(data):
    from sleec_verify.encoding.local_search import search_nearby

    drawn = data.draw
    terms = [(("x",),), (("y",),), (("x", "y"),), (("x", "x"),), (("y", "z"),)]
    sums = drawn(
        st.lists(st.lists(st.sampled_from(terms), min_size=1, max_size=3, unique=True), min_size=1, max_size=2)
    )
    factors = st.sampled_from((-2, -1, 1, 3))
    calculations = [Calculation(tuple((drawn(factors), names) for (names,) in terms)) for terms in sums]
    signs, bounds = st.sampled_from((1, -1)), st.integers(-6, 12)
    cuts = [(name, drawn(bounds), drawn(st.booleans()), drawn(signs)) for name in NAMES if drawn(st.booleans())]
    compared = [(one, drawn(bounds), drawn(st.booleans()), drawn(signs)) for one in calculations]
    orders = [("x", "y", drawn(signs))] if drawn(st.booleans()) else []
    start = dict.fromkeys(NAMES, 0)
    for name, value, inclusive, sign in cuts:
        start[name] = value + (0 if inclusive == (sign > 0) else -sign)
    found = search_nearby(start, cuts, orders, compared)
    if found is None:
        return
    for side, value, inclusive, sign in [
        *((found[name], *cut) for name, *cut in cuts),
        *((one.value(found), *cut) for one, *cut in compared),
    ]:
        assert (side <= value if inclusive else side < value) == (sign > 0)
    assert all((found[x] <= found[y]) == (sign > 0) for x, y, sign in orders)


def test_what_is_too_hard_is_unknown(monkeypatch):
    pytest.importorskip("z3")
    from sleec_verify.encoding import arithmetic

    arithmetic.answer.cache_clear()
    monkeypatch.setattr(arithmetic, "RESOURCES", 1)
    (calculated,) = calculations_in(guard_of("(({x} * {y}) > 3)"))
    compared = [(calculated, 7, True, -1), (calculated, 8, True, 2)]
    with pytest.raises(NotCalculated, match=r"z3 could not decide the values of `x \* y` in line 11") as caught:
        arithmetic.values_for({"x": True, "y": True}, [], [], compared)
    arithmetic.answer.cache_clear()
    assert caught.value.lines == (11,)
