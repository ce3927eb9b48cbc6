"""Every certificate that does not hold is refused, for its reason."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.certificate.coverage import Use
from sleec_runtime.certificate.manifest import FORMAT, Required, canonical
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.language import load
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.verification import check_certificate
from tests.support.paths import ROOT
from tests.thorough.certificates.test_certificates import CONSTRAINED, source, written

CONFLICTING = """
MEASURE Age: number
MEASURE Risk: low < middle < high
CONDITION Awake
RULE a WHEN A THEN X UNLESS Awake IN WHICH CASE Y
RULE b WHEN A AND Age > 1.5 AND Risk >= middle THEN NOT X
"""
TIMED = """
RULE a WHEN A THEN X WITHIN 5 seconds
RULE b WHEN B THEN NOT X WITHIN 10 seconds
"""

Change = Callable[[Path], object]
Manifest = dict[str, Any]


@pytest.fixture(scope="module", params=["proved", "refuted", "timed"])
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with rules and their certificate."""
    return certified(request.param, tmp_path_factory.mktemp("made"))


def certified(kind: str, folder: Path) -> Path:
    written(source({"proved": CONSTRAINED, "refuted": CONFLICTING, "timed": TIMED}[kind], folder), folder / "c")
    return folder


def reasons(folder: Path, **use: Any) -> set[str]:
    """Why the certificate of the rules in this folder is refused for a use of them."""
    try:
        ruleset = load(folder / "rules.sleec")
        check_certificate(ruleset, str(folder / "c"), IN_PYTHON, Use(**{"reading": ruleset.reading, **use}))
    except CertificateRefused as refusal:
        return {reason for reason, message in refusal.problems if message}
    return set()


def copied(made: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(made, tmp_path / "copy"))


def rewrite(folder: Path, change: Callable[[Manifest], object]) -> None:
    """Change the manifest, and make the hashes in it right again."""
    path = folder / "c" / "manifest.json"
    manifest = json.loads(path.read_text())
    change(manifest)
    path.write_bytes(canonical(manifest))


def rehash(folder: Path) -> None:
    def fit(manifest: Manifest) -> None:
        for name in manifest["files"]:
            manifest["files"][name] = hashlib.sha256((folder / "c" / name).read_bytes()).hexdigest()

    rewrite(folder, fit)


def test_what_was_not_touched_holds(made: Path) -> None:
    assert reasons(made) == set()


def test_rules_changed_by_a_byte(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    (folder / "rules.sleec").write_text((made / "rules.sleec").read_text() + "\n")
    assert reasons(folder) == {"ruleset-changed"}


def test_no_certificate(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    for text in ("", "[]", "{}", "{" * 100_000, "\x00", '{"certificate": "sleec", "format": 2}'):
        (folder / "c" / "manifest.json").write_text(text)
        assert reasons(folder) == {"no-certificate"}
    (folder / "c" / "manifest.json").unlink()
    assert reasons(folder) == {"no-certificate"}


@pytest.mark.parametrize("version", [0, FORMAT - 1, FORMAT + 1, str(FORMAT), float(FORMAT), True, None, [FORMAT]])
def test_another_version_of_the_format(made: Path, tmp_path: Path, version: object) -> None:
    folder = copied(made, tmp_path)
    rewrite(folder, lambda m: m.update(format=version))
    assert reasons(folder) == {"format"}


def test_a_file_added(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    (folder / "c" / "more.cnf").write_text("p cnf 0 0\n")
    assert reasons(folder) == {"file-added"}


PROVED_FILES = ["conflict.cnf", "conflict.lrat", "dead-rule.lrat"]


@pytest.fixture(scope="module")
def proofs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return certified("proved", tmp_path_factory.mktemp("proofs"))


@pytest.mark.parametrize("name", PROVED_FILES)
def test_a_file_missing(proofs: Path, tmp_path: Path, name: str) -> None:
    folder = copied(proofs, tmp_path)
    (folder / "c" / name).unlink()
    assert reasons(folder) == {"file-missing"}
    rewrite(folder, lambda m: m["files"].pop(name))
    assert reasons(folder) == {"file-missing", "manifest"}


@pytest.mark.parametrize("name", PROVED_FILES)
def test_a_file_that_is_a_folder(proofs: Path, tmp_path: Path, name: str) -> None:
    folder = copied(proofs, tmp_path)
    (folder / "c" / name).unlink()
    (folder / "c" / name).mkdir()
    assert reasons(folder) == {"file-missing"}


@pytest.mark.parametrize("name", ["manifest.json", *PROVED_FILES])
@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_what_is_no_file_is_not_read(proofs: Path, tmp_path: Path, name: str, kind: str) -> None:
    """To read it would never end."""
    folder = copied(proofs, tmp_path)
    path = folder / "c" / name
    path.unlink()
    if kind == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")
    assert reasons(folder) == {"no-certificate" if name == "manifest.json" else "file-missing"}


def test_a_link_to_the_same_bytes_is_as_good(proofs: Path, tmp_path: Path) -> None:
    folder = copied(proofs, tmp_path)
    path = folder / "c" / "conflict.lrat"
    path.rename(folder / "elsewhere")
    path.symlink_to(folder / "elsewhere")
    assert reasons(folder) == set()
    (folder / "elsewhere").write_text("")
    assert reasons(folder) == {"file-changed", "proof"}
    (folder / "elsewhere").unlink()
    assert reasons(folder) == {"file-missing"}


@pytest.mark.parametrize("name", ["../rules.sleec", "/etc/hostname", "..", ""])
def test_a_file_elsewhere_is_no_part_of_it(proofs: Path, tmp_path: Path, name: str) -> None:
    folder = copied(proofs, tmp_path)
    rewrite(folder, lambda m: m["files"].update({name: "0" * 64}))
    assert reasons(folder) == {"manifest"}


@pytest.mark.parametrize("kept", [0, 1, 2])
def test_a_truncated_proof(proofs: Path, tmp_path: Path, kept: int) -> None:
    folder = copied(proofs, tmp_path)
    path = folder / "c" / "conflict.lrat"
    lines = path.read_text().splitlines(keepends=True)
    assert len(lines) > 3
    path.write_text("".join(lines[:kept]))
    assert reasons(folder) == {"file-changed", "proof"}
    rehash(folder)
    assert reasons(folder) == {"proof"}


def test_a_proof_that_is_no_text(proofs: Path, tmp_path: Path) -> None:
    folder = copied(proofs, tmp_path)
    (folder / "c" / "conflict.lrat").write_text("5 0 1 0 \u00e9\n")
    rehash(folder)
    assert reasons(folder) == {"proof"}


def test_a_proof_of_other_clauses(proofs: Path, tmp_path: Path) -> None:
    """Both files of another check, a formula and a refutation of it, in the place of this one's."""
    folder = copied(proofs, tmp_path)
    for kind in ("cnf", "lrat"):
        shutil.copy(folder / "c" / f"dead-rule.{kind}", folder / "c" / f"conflict.{kind}")
    assert reasons(folder) == {"file-changed", "clauses"}
    rehash(folder)
    assert reasons(folder) == {"clauses"}


def test_a_clause_dropped_from_the_formula(proofs: Path, tmp_path: Path) -> None:
    folder = copied(proofs, tmp_path)
    path = folder / "c" / "conflict.cnf"
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(lines[:-1]))
    rehash(folder)
    assert reasons(folder) == {"clauses"}


def test_a_verdict_flipped(made: Path, tmp_path: Path) -> None:
    for number, verdict in ((0, "proved"), (0, "refuted"), (0, "unknown"), (3, "refuted"), (5, "unknown")):
        folder = copied(made, tmp_path)

        def flip(manifest: Manifest, number: int = number, verdict: str = verdict) -> None:
            manifest["checks"][number]["verdict"] = verdict

        before = json.loads((folder / "c" / "manifest.json").read_text())["checks"][number]["verdict"]
        rewrite(folder, flip)
        assert reasons(folder) == ({"verdict"} if verdict != before else set())
        shutil.rmtree(folder)


def test_a_check_left_out_or_made_up(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    rewrite(folder, lambda m: m["checks"].pop())
    assert reasons(folder) == {"verdict"}
    rewrite(folder, lambda m: m["checks"].append({**m["checks"][0], "name": "kindness"}))
    assert reasons(folder) == {"verdict", "manifest"}
    folder = copied(made, tmp_path / "again")
    rewrite(folder, lambda m: m["checks"].append(m["checks"][0]))
    assert reasons(folder) == {"manifest"}


def change_entry(key: str, value: object) -> Callable[[Manifest], object]:
    return lambda m: m["checks"][0].update({key: value})


@pytest.mark.parametrize(("key", "value"), [("evidence", "proof!"), ("models", 77), ("files", ["x"]), ("reason", "so")])
def test_another_word_on_a_check(made: Path, tmp_path: Path, key: str, value: object) -> None:
    folder = copied(made, tmp_path)
    rewrite(folder, change_entry(key, value))
    assert reasons(folder) == {"manifest"}


@pytest.mark.parametrize("key", ["tool", "ruleset", "checks", "files", "reading", "domain", "untimed", "chains"])
def test_a_manifest_without_an_entry(made: Path, tmp_path: Path, key: str) -> None:
    folder = copied(made, tmp_path)
    rewrite(folder, lambda m: m.pop(key))
    assert reasons(folder) == {"manifest"}


@pytest.mark.parametrize("kind", ["proved", "timed"])
def test_a_manifest_that_says_something_else_of_time(tmp_path: Path, kind: str) -> None:
    folder = certified(kind, tmp_path)
    other = {"untimed": None, "chains": False} if kind == "timed" else {"untimed": "at", "chains": True}
    rewrite(folder, lambda m: m.update(other))
    assert reasons(folder) == {"manifest"}
    rewrite(folder, lambda m: m.update(chains=not m["chains"]))
    assert reasons(folder) == {"manifest"}


def test_more_in_the_manifest(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    rewrite(folder, lambda m: m.update(blessed=True))
    assert reasons(folder) == {"manifest"}
    rewrite(folder, lambda m: (m.pop("blessed"), m["ruleset"].update(rules=99)))
    assert reasons(folder) == {"manifest"}


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("untimed", "sometime", "manifest"),
        ("reading", "backwards", "manifest"),
        ("domain", "kitchen", "manifest"),
    ],
)
def test_checked_as_something_else(proofs: Path, tmp_path: Path, key: str, value: str, expected: str) -> None:
    folder = copied(proofs, tmp_path)
    rewrite(folder, lambda m: m.update({key: value}))
    assert expected in reasons(folder)


def test_checked_in_another_reading(proofs: Path, tmp_path: Path) -> None:
    folder = copied(proofs, tmp_path)
    rewrite(folder, lambda m: m.update(reading="priority"))
    assert "clauses" in reasons(folder, reading="priority")


def test_another_version_of_the_tool_is_named(proofs: Path, tmp_path: Path) -> None:
    folder = copied(proofs, tmp_path)
    rewrite(folder, lambda m: m["tool"].update(version="9.9"))
    assert reasons(folder) == set()
    (folder / "c" / "conflict.cnf").write_text("")
    with pytest.raises(CertificateRefused) as refusal:
        check_certificate(load(folder / "rules.sleec"), str(folder / "c"), IN_PYTHON)
    assert "version 9.9 wrote it" in str(refusal.value.hint)


@pytest.fixture(scope="module")
def witnesses(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return certified("refuted", tmp_path_factory.mktemp("witnesses"))


def witness(change: Callable[[Manifest], object]) -> Callable[[Manifest], object]:
    return lambda m: change(m["checks"][0]["findings"][0]["witness"])


def values(**changed: object) -> Callable[[Manifest], object]:
    return witness(lambda w: w["conditions"].update(changed))


@pytest.mark.parametrize(
    "change",
    [
        values(Awake=True),
        values(Age=1),
        values(Age="1/0"),
        values(Age="old"),
        values(Age="1e999999999"),
        values(Age=True),
        values(Risk="low"),
        values(Risk="highest"),
        values(Risk=2),
        values(Awake="false"),
        values(Unheard=True),
        witness(lambda w: w.update(triggers=[])),
        witness(lambda w: w.update(triggers=["Z"])),
        lambda m: m["checks"][0]["findings"][0].update(witness=None),
        # Each situation is written in one way.
        witness(lambda w: w.update(triggers=["A", "A"])),
        witness(lambda w: w.update(conditions=dict(reversed(w["conditions"].items())))),
        values(Age=7.0),
        values(Age="14/2"),
        values(Age="7/1"),
        values(Age="5/2"),
    ],
)
def test_a_witness_that_does_not_show_it(witnesses: Path, tmp_path: Path, change: Callable[[Manifest], object]) -> None:
    folder = copied(witnesses, tmp_path)
    rewrite(folder, change)
    assert reasons(folder) == {"witness"}


@pytest.mark.parametrize("change", [values(Age="8/3"), values(Age=2.5), values(Risk="high"), values(Age=7)])
def test_another_witness_that_shows_it_too(
    witnesses: Path, tmp_path: Path, change: Callable[[Manifest], object]
) -> None:
    folder = copied(witnesses, tmp_path)
    rewrite(folder, change)
    assert reasons(folder) == set()


@pytest.mark.parametrize(
    "change",
    [
        lambda m: m["checks"][0]["findings"].pop(),
        lambda m: m["checks"][0]["findings"].append(m["checks"][0]["findings"][0]),
        lambda m: m["checks"][0]["findings"][0].update(rules=["a"]),
        lambda m: m["checks"][0]["findings"][0].update(code="SLEEC999"),
    ],
)
def test_other_findings(witnesses: Path, tmp_path: Path, change: Callable[[Manifest], object]) -> None:
    folder = copied(witnesses, tmp_path)
    rewrite(folder, change)
    assert reasons(folder) == {"findings"}


def test_another_course_of_events(tmp_path: Path) -> None:
    folder = certified("timed", tmp_path)

    def change(manifest: Manifest) -> None:
        finding = manifest["checks"][0]["findings"][0]
        finding["timeline"]["moments"][0]["time"] += 1

    rewrite(folder, change)
    assert reasons(folder) == {"witness"}


def test_every_reason_is_in_the_docs() -> None:
    page = (ROOT / "docs" / "certificates.md").read_text(encoding="utf-8")
    _, _, section = page.partition("## When a certificate is rejected")
    told = set(re.findall(r"^\| `([a-z-]+)` \|", section.partition("\n## ")[0], flags=re.MULTILINE))
    modules = (
        "sleec_verify/certificates/verification.py",
        "sleec_runtime/certificate/coverage.py",
        "sleec_runtime/certificate/manifest.py",
        "sleec_runtime/certificate/requirement.py",
        "sleec_runtime/certificate/signature.py",
    )
    code = "".join((ROOT / name).read_text(encoding="utf-8") for name in modules)
    required = {f"not-{name}" for name in Required._fields}
    assert told == required | set(re.findall(r'(?:Problem|_refused|CertificateRefused)[(\[\s]+"([a-z-]+)",', code))
