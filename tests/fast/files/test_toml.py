"""Files in TOML: the configuration and cases. Whatever they hold, the error is typed and short."""

from __future__ import annotations

import time
from decimal import Decimal
from pathlib import Path

import pytest

from sleec_runtime.errors import SleecError
from sleec_runtime.language import parse
from sleec_verify.conformance.cases.case import CasesError
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.files.toml import parse_toml, read_toml

RULES = parse("MEASURE Age: number\nWHEN Ring THEN Open UNLESS Asleep AND Age < 3 IN WHICH CASE Wait")
CASE = "[[case]]\nobligations = []\n"


def test_a_table(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_bytes(b"\xef\xbb\xbfa = 36.6\nb = 0x7fff_ffff_ffff_ffff\n")
    assert read_toml(path, "a.toml", SleecError, Decimal) == {"a": Decimal("36.6"), "b": 2**63 - 1}


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"\xff", "a.toml is not UTF-8"),
        (b"a =", "a.toml is not TOML: "),
        (b"a = " + b"[" * 100_000, "a.toml is nested too deeply"),
        (b"a = " + b"{a=" * 100_000, "a.toml is nested too deeply"),
        (b"a = " + b"9" * 10_000, "a.toml is not TOML: "),
        (b"a = [{b = 0x" + b"f" * 10_000 + b"}]", "a.toml is not TOML: an integer has more than 64 bits"),
        (b"a = 0x8000_0000_0000_0000", "a.toml is not TOML: an integer has more than 64 bits"),
    ],
    ids=["bytes", "syntax", "arrays", "tables", "digits", "hexadecimal digits", "64 bits"],
)
def test_no_table(data: bytes, message: str) -> None:
    with pytest.raises(CasesError) as caught:
        parse_toml(data, "a.toml", CasesError)
    assert caught.value.message.startswith(message)


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(CasesError, match=r"file a\.toml does not exist"):
        read_toml(tmp_path / "a.toml", "a.toml", CasesError)
    with pytest.raises(CasesError, match=r"a\.toml cannot be read"):
        read_toml(tmp_path, "a.toml", CasesError)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (CASE + "given = { Age = 1e99999999 }", r"`Age` must be a number, not `1E\+99999999`"),
        (CASE + "given = { Age = -1e-99999999 }", "`Age` must be a number, not `-1E-99999999`"),
        (CASE + 'given = { " Age " = 5 }', "` Age ` is not a name"),
        (CASE + 'given = { "Age=" = 5 }', "`Age=` is not a name"),
        (CASE + "given = { Age = nan }", "`Age` must be a number, not `NaN`"),
        (CASE + "given = { Age = -inf }", "`Age` must be a number, not `-Infinity`"),
        (CASE + f'given = {{ Age = "{"9" * 5000}/3" }}', "`Age` must be a number"),
        (CASE + 'given = { Age = "٣/٤" }', "`Age` must be a number"),
        (CASE + 'given = { Age = "3/0" }', "`Age` must be a number"),
        (CASE + 'given = { "Age=3,Asleep" = true }', "`Age` must be a number"),
        (CASE + 'given = { "Asleep,Asleep" = true }', "no condition or measure is called"),
        (CASE + "reaches = 3", "reaches is 3"),
        (CASE + "reaches = [3]", r"reaches is \[3\]"),
        (CASE + f"when = [{'[],' * 5000}]", "when is "),
        (CASE + f"given = [{'[],' * 5000}]", "given is "),
        (CASE + f"domain = [{'[],' * 5000}]", "no domain is called "),
        (CASE + f'domain = "{"x" * 5000}"', "no domain is called "),
        (CASE + f"given = {{ Age = [{'[],' * 5000}] }}", "Age is "),
        (CASE + f"prohibitions = [{'[],' * 5000}]", "obligations are "),
        (CASE + f"prohibitions = ['{'x' * 5000}']", "no obligation is called "),
        (CASE + f"name = [{'[],' * 5000}]", "name is "),
        (CASE + f"{'x' * 5000} = 1", "unknown key "),
        (f"reading = [{'[],' * 5000}]\n" + CASE, "the reading is "),
    ],
)
def test_cases_that_are_none(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "a.cases.toml"
    path.write_text(text, encoding="utf-8")
    start = time.process_time()
    with pytest.raises(CasesError, match=message) as caught:
        read_cases(path, RULES)
    assert time.process_time() - start < 2
    assert len(str(caught.value)) < 1000


@pytest.mark.parametrize("value", ["1e3", "1000.0", '"1000"', '"2000/2"', '"-3000/-3"'])
def test_numbers_in_cases(value: str, tmp_path: Path) -> None:
    path = tmp_path / "a.cases.toml"
    path.write_text(f"{CASE}given = {{ Age = {value} }}")
    (case,) = read_cases(path, RULES).situations
    assert case.conditions == {"Age": 1000}
