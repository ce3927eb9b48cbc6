"""The manifest has one parser, which accepts exactly what is written: any other byte is refused."""

from __future__ import annotations

import copy
import hashlib
import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import sleec_runtime
from sleec_runtime.certificate.manifest import canonical, parse
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.language import parse as parse_rules
from sleec_verify.certificates.certification import certify
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.verification import check_certificate
from sleec_verify.cli import run
from tests.fast.certificates.test_refused import CONFLICTING, TIMED
from tests.thorough.certificates.test_certificates import CONSTRAINED, source, written

ABSENT = "RULE a WHEN A THEN X UNLESS B\nRULE b WHEN B THEN Y\nRULE c WHEN C THEN NOT X\n"
TEXTS = {"proved": CONSTRAINED, "refuted": CONFLICTING, "timed": TIMED, "absent": ABSENT}
Path_ = tuple[Any, ...]


@cache
def manifest(kind: str) -> bytes:
    text = TEXTS[kind]
    ruleset = parse_rules(text, sha256=hashlib.sha256(text.encode()).hexdigest())
    return dict(certify(ruleset).contents())["manifest.json"]


def reason(data: bytes) -> str | None:
    """Why the parser refuses these bytes. It raises nothing else, and reads what it accepts as it is written."""
    try:
        read = parse(data, "manifest.json")
    except CertificateRefused as refusal:
        ((found, _),) = refusal.problems
        return found
    assert canonical(read.whole) == data
    return None


@pytest.mark.parametrize("kind", TEXTS)
def test_what_is_written_is_read(kind: str) -> None:
    data = manifest(kind)
    assert data.isascii()
    assert parse(data, "manifest.json").whole == json.loads(data)


# The same content, written in another way --------------------------------------------------------------------


def doubled(data: bytes, key: bytes) -> bytes:
    """With the line of a key twice."""
    (line,) = (line for line in data.splitlines(keepends=True) if line.startswith(b' "' + key + b'"'))
    return data.replace(line, line * 2)


REWRITTEN = {
    "UTF-16": lambda data: data.decode().encode("utf-16"),
    "UTF-16 without a mark": lambda data: data.decode().encode("utf-16-le"),
    "UTF-32": lambda data: data.decode().encode("utf-32"),
    "a byte order mark": lambda data: b"\xef\xbb\xbf" + data,
    "other line breaks": lambda data: data.replace(b"\n", b"\r\n"),
    "no line break at the end": lambda data: data[:-1],
    "a line break more at the end": lambda data: data + b"\n",
    "other indentation": lambda data: json.dumps(json.loads(data), indent=2).encode(),
    "other separators": lambda data: json.dumps(json.loads(data), separators=(",", ":")).encode(),
    "other keys first": lambda data: canonical(dict(reversed(json.loads(data).items()))),
    "a key twice": lambda data: doubled(data, b"reading"),
    "a key twice with another value first": lambda data: data.replace(b'"reading"', b'"reading": "no", "reading"'),
    "a name of a check twice": lambda data: data.replace(b'{"name": "conflict"', b'{"name": "x", "name": "conflict"'),
    "an escape that is not needed": lambda data: data.replace(b'"cascade"', b'"c\\u0061scade"'),
    "a number in another notation": lambda data: data.replace(b'"refuted": 0', b'"refuted": -0'),
    "bytes that are not UTF-8": lambda data: data.replace(b'"cascade"', b'"cascade\xff"'),
}


@pytest.mark.parametrize("kind", TEXTS)
@pytest.mark.parametrize("name", REWRITTEN)
def test_there_is_one_way_to_write_it(kind: str, name: str) -> None:
    data = manifest(kind)
    other = REWRITTEN[name](data)
    assert other != data
    assert reason(other) in ("manifest", "no-certificate")


# Other keys and types, anywhere ------------------------------------------------------------------------------


def places(value: Any, path: Path_ = ()) -> Iterator[tuple[Path_, Any]]:
    """Every value in a manifest, with the way to it."""
    yield path, value
    if isinstance(value, dict):
        for key, one in value.items():
            yield from places(one, (*path, key))
    elif isinstance(value, list):
        for number, one in enumerate(value):
            yield from places(one, (*path, number))


def with_value(whole: Any, path: Path_, value: Any) -> Any:
    changed = copy.deepcopy(whole)
    at = changed
    for step in path[:-1]:
        at = at[step]
    at[path[-1]] = value
    return changed


OTHERS: tuple[Any, ...] = (None, True, False, 0, 1, -1, 1.0, 2.5, "", "1", "x", [], ["x"], [1], {}, {"x": 1})


@pytest.mark.slow
@pytest.mark.parametrize("kind", TEXTS)
def test_values_of_another_type_are_refused_everywhere(kind: str) -> None:
    whole = json.loads(manifest(kind))
    tried = 0
    for path, value in places(whole):
        # What a situation says is a value of any kind; all else has one type, or may be null.
        if not path or "conditions" in path:
            continue
        for other in OTHERS:
            if type(other) is not type(value) and other is not None and value is not None:
                tried += 1
                assert reason(canonical(with_value(whole, path, other))) is not None, (path, other)
    assert tried > 1_000


@pytest.mark.parametrize("kind", TEXTS)
def test_no_key_may_be_missing_added_or_moved(kind: str) -> None:
    whole = json.loads(manifest(kind))
    for path, value in places(whole):
        if not isinstance(value, dict) or path[-1:] == ("files",) or path[-1:] == ("conditions",):
            continue
        others = [{**value, "more": 1}, {"more": 1, **value}, dict(reversed(value.items()))]
        others += [{k: v for k, v in value.items() if k != key} for key in value if key not in ("timeline", "absent")]
        for other in others:
            assert reason(canonical(with_value(whole, path, other) if path else other)) is not None, (path, other)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("format",), True),
        (("reading",), "backwards"),
        (("tool", "name"), "other"),
        (("tool", "version"), "1\n2"),
        (("ruleset", "syntax"), "prolog"),
        (("ruleset", "sha256"), "0" * 63),
        (("ruleset", "sha256"), "A" * 64),
        (("checks", 0, "verdict"), "fine"),
        (("checks", 0, "evidence"), "belief"),
        (("checks", 0, "files"), ["../x.cnf"]),
        (("checks", 0, "name"), "vacuous-conflict"),  # which is there already
        (("files", "../x.cnf"), "0" * 64),
        (("files", "conflict.cnf\n"), "0" * 64),
    ],
)
def test_values_that_there_are_not(path: Path_, value: Any) -> None:
    whole = json.loads(manifest("proved"))
    assert reason(canonical(with_value(whole, path, value))) in ("manifest", "format")


@pytest.mark.parametrize("text", ["NaN", "Infinity", "-Infinity", "1e999", "9" * 5000, "[" * 100_000])
def test_what_is_no_value_of_json_is_refused(text: str) -> None:
    data = manifest("refuted").replace(b'"Age": 2', b'"Age": ' + text.encode())
    assert data != manifest("refuted")
    assert reason(data) in ("manifest", "no-certificate")


def test_a_message_shows_no_control_characters(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever names a manifest has."""
    source(CONFLICTING, tmp_path)
    (tmp_path / "c").mkdir()
    path = ("checks", 0, "findings", 0, "witness", "conditions", "\x1b[2J\n::stop-commands::x")
    data = canonical(with_value(json.loads(manifest("refuted")), path, []))
    (tmp_path / "c" / "manifest.json").write_bytes(data)
    assert run(["certify", "--check", str(tmp_path / "c"), str(tmp_path / "rules.sleec")]) == 2
    said = capsys.readouterr().err
    assert "stop-commands" in said
    assert "\x1b" not in said
    assert "\n::" not in said


# Any bytes at all --------------------------------------------------------------------------------------------


@st.composite
def mutated(draw: st.DrawFn, kinds: tuple[str, ...] = tuple(TEXTS)) -> tuple[str, bytes]:
    """A manifest with some bytes changed, added, left out, doubled or moved; mostly where it says something."""
    kind = draw(st.sampled_from(kinds))
    data = manifest(kind)
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(data) - 1))
        end = min(len(data), start + draw(st.integers(0, 12)))
        elsewhere = draw(st.integers(0, len(data) - 1))
        words = (b"true", b"null", b"0", b"1", b"2.5", b'"', b"\n", b" ", b'"x": 1, ')
        pieces = st.sampled_from((*words, data[start:end] * 2, data[elsewhere : elsewhere + 8]))
        filling = draw(st.one_of(st.binary(max_size=4), pieces))
        data = data[:start] + filling + data[end:]
    return kind, data


@pytest.mark.slow
@given(mutated())
@settings(max_examples=1_000, suppress_health_check=[HealthCheck.too_slow])
def test_any_bytes_are_refused_or_the_one_way_to_write_what_they_say(changed: tuple[str, bytes]) -> None:
    reason(changed[1])


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    made = {}
    for kind, text in TEXTS.items():
        made[kind] = tmp_path_factory.mktemp(kind)
        written(source(text, made[kind]), made[kind] / "c")
        assert (made[kind] / "c" / "manifest.json").read_bytes() == manifest(kind)
    return made


def claims(data: bytes) -> Any:
    """What a manifest says that is computed again: all but the version of the tool, on which nothing depends, what is
    required, which is required again, and situations, which are evaluated."""
    whole = json.loads(data)
    whole["tool"]["version"] = whole["required"] = None
    for check in whole["checks"]:
        for finding in check["findings"]:
            finding["witness"] = None if finding["witness"] is None else "a situation"
    return whole


@given(mutated(("proved", "refuted")))
@settings(max_examples=150, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
def test_any_change_of_the_manifest_is_refused_by_check(folders: dict[str, Path], changed: tuple[str, bytes]) -> None:
    kind, data = changed
    folder = folders[kind]
    (folder / "c" / "manifest.json").write_bytes(data)
    ruleset = sleec_runtime.language.load(folder / "rules.sleec")
    try:
        check_certificate(ruleset, str(folder / "c"), IN_PYTHON)
    except CertificateRefused:
        assert data != manifest(kind)
    else:
        assert claims(data) == claims(manifest(kind))


@pytest.mark.parametrize("kind", TEXTS)
def test_no_value_can_be_another_under_check(folders: dict[str, Path], kind: str) -> None:
    """One value after the other, with one of its own type."""
    folder, whole = folders[kind], json.loads(manifest(kind))
    ruleset = sleec_runtime.language.load(folder / "rules.sleec")
    for path, value in places(whole):
        skipped = not path or path[0] in ("tool", "required") or "witness" in path
        # One check of each kind is enough.
        skipped = skipped or (path[0] == "checks" and len(path) > 1 and path[1] > 1)
        if skipped or isinstance(value, (dict, list)) or len(path) < 2:
            continue
        other = not value if isinstance(value, bool) else value + 1 if isinstance(value, int) else f"{value}x"
        (folder / "c" / "manifest.json").write_bytes(canonical(with_value(whole, path, other)))
        with pytest.raises(CertificateRefused):
            check_certificate(ruleset, str(folder / "c"), IN_PYTHON)
