"""``certify`` and ``check --certify``: exit codes, what is printed, and what is never overwritten."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from sleec_verify.certificates.directory import write_folder
from tests.support.cli import Cli

CLEAN = "RULE a WHEN A THEN X UNLESS C IN WHICH CASE Y\nRULE b WHEN A THEN Z UNLESS C IN WHICH CASE NOT X\n"
CONFLICT = "RULE a WHEN A THEN X\nRULE b WHEN A THEN NOT X\n"
FILES = {"clean.sleec": CLEAN, "conflict.sleec": CONFLICT}


def tree(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_exit_codes_are_those_of_check(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    assert cli("certify", "clean.sleec", "-o", "a", files=FILES).code == 0
    assert cli("certify", "--check", "a", "clean.sleec").code == 0
    assert cli("certify", "conflict.sleec", "-o", "b").code == 1
    assert cli("certify", "--check", "b", "conflict.sleec").code == 1
    never = "NEVER A AND NOT B\nNEVER B AND C\nRULE a WHEN T THEN A AND C\n"
    monkeypatch.setattr("sleec_verify.query.prime_implicates.STEPS", 0)
    ran = cli("certify", "unknown.sleec", "-o", "c", files={"unknown.sleec": never})
    assert (ran.code, "unknown   no proof, because there is no verdict" in ran.out) == (3, True)
    assert cli("certify", "--check", "c", "unknown.sleec").code == 3


def test_check_certifies_too(cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "clean.sleec", "--certify", "a", files=FILES)
    assert ran.out == cli("check", "clean.sleec").out
    cli("certify", "clean.sleec", "-o", "b")
    assert tree(tmp_path / "a") == tree(tmp_path / "b")
    assert cli("check", "clean.sleec", "--certify", "a").code == 2
    assert "needs exactly one file" in cli("check", "clean.sleec", "conflict.sleec", "--certify", "c").err
    assert cli("check", "nothing.sleec", "--certify", "c").code == 2
    assert not (tmp_path / "c").exists()


def test_what_is_told(cli: Cli) -> None:
    out = cli("certify", "clean.sleec", "-o", "new/place", files=FILES).out
    assert "conflict            proved    1 question refuted: conflict.cnf, conflict.lrat\n" in out
    held = cli("certify", "--check", "new/place", "clean.sleec").out
    assert held.startswith("new/place: valid certificate of clean.sleec (reading cascade; with chains)\n")
    *_, judged, tied = held.splitlines()
    assert judged.startswith("proofs checked by ")
    assert tied.startswith("conflict: ")


def test_it_is_told_who_judged(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cli("certify", "clean.sleec", "-o", "a", files=FILES)
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\necho VERIFIED\n")
    program.chmod(0o755)

    def judged(*options: str) -> str:
        return cli("certify", "--check", "a", "clean.sleec", *options).out.splitlines()[-2]

    assert judged("--checker", str(program)) == f"proofs checked by {program}"
    monkeypatch.setattr("sleec_verify.certificates.checker.BUILT", program)
    assert judged() == f"proofs checked by {program}, which is proved correct"
    monkeypatch.setattr("sleec_verify.certificates.checker.BUILT", tmp_path / "none")
    assert "in Python; `make -C proofs/checker`" in judged()


def test_it_is_told_what_ties_the_verdict_to_the_rules(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sleec_verify.certificates.theory.oracle.BUILT", tmp_path / "none")
    cli("certify", "clean.sleec", "-o", "a", files=FILES)
    ran = cli("certify", "--check", "a", "clean.sleec")
    assert ran.code == 0
    unbuilt = "the oracle is not built (make proofs)"
    untied = "not proved that the formula is the one of the rules"
    assert ran.out.splitlines()[-1] == f"conflict: {untied}: {unbuilt}"
    told = json.loads(cli("certify", "--check", "a", "clean.sleec", "--format", "json").out)
    assert told["theory"] == {"conflict": {"proved": False, "reason": unbuilt}}
    hedged = "RULE a WHEN T THEN X UNLESS C IN WHICH CASE Y UNLESS C AND D IN WHICH CASE Z\n"
    cli("certify", "hedged.sleec", "-o", "h", files={"hedged.sleec": hedged})
    ran = cli("certify", "--check", "h", "hedged.sleec")
    assert ran.out.splitlines()[-2:] == [f"{check}: {untied}: {unbuilt}" for check in ("conflict", "reading")]
    # Of a conflict there is a situation: what needs to be tied is that a rule can be kept in none.
    cli("certify", "conflict.sleec", "-o", "b")
    said = cli("certify", "--check", "b", "conflict.sleec").out.splitlines()
    assert said[-2].startswith("proofs checked by ")
    assert said[-1] == f"vacuous-conflict: {untied}: {unbuilt}"
    told = json.loads(cli("certify", "--check", "b", "conflict.sleec", "--format", "json").out)
    assert told["theory"].keys() == {"vacuous-conflict"}


def test_as_json(cli: Cli, tmp_path: Path) -> None:
    made = json.loads(cli("certify", "clean.sleec", "-o", "a", "--format", "json", files=FILES).out)
    assert made["checks"][0] == {
        "name": "conflict",
        "verdict": "proved",
        "evidence": "proof",
        "files": ["conflict.cnf", "conflict.lrat"],
        "traces": 0,
    }
    held = json.loads(cli("certify", "--check", "a", "clean.sleec", "--format", "json").out)
    assert held["holds"] is True
    assert set(held["checker"]) == {"name", "proved"}
    (tmp_path / "a" / "conflict.lrat").write_text("")
    ran = cli("certify", "--check", "a", "clean.sleec", "--format", "json")
    assert ran.code == 2
    refused = json.loads(ran.out)
    assert refused["holds"] is False
    assert {problem["reason"] for problem in refused["problems"]} == {"file-changed", "proof"}


def test_a_refusal_is_told_with_its_reasons(cli: Cli) -> None:
    cli("certify", "clean.sleec", "-o", "a", files=FILES)
    ran = cli("certify", "--check", "a", "conflict.sleec")
    assert (ran.code, ran.out) == (2, "")
    assert "the certificate is not of these rules: conflict.sleec has other bytes" in ran.err


def test_rules_that_are_none_any_more(cli: Cli) -> None:
    cli("certify", "clean.sleec", "-o", "a", files=FILES)
    ran = cli("certify", "--check", "a", "clean.sleec", files={"clean.sleec": "RULE a WHEN\n"})
    assert (ran.code, "the certificate is of another text" in ran.err) == (2, True)


def test_nothing_else_is_overwritten(cli: Cli, tmp_path: Path) -> None:
    files = {**FILES, "mine/notes.txt": "mine", "file": "mine", "other/manifest.json": "{}"}
    cli("certify", "clean.sleec", "-o", "a", files=files)
    (tmp_path / "a" / "notes.txt").write_text("mine")
    (tmp_path / "link").symlink_to(tmp_path / "mine")
    before = tree(tmp_path)
    for place in ("mine", "file", "other", "a", "link", "file/below"):
        for force in ([], ["--force"]):
            ran = cli("certify", "conflict.sleec", "-o", place, *force)
            assert (ran.code, ran.out) == (2, ""), place
            assert tree(tmp_path) == before


def test_a_certificate_is_replaced_only_with_force(cli: Cli, tmp_path: Path) -> None:
    cli("certify", "clean.sleec", "-o", "a", files=FILES)
    (tmp_path / "empty").mkdir()
    assert cli("certify", "clean.sleec", "-o", "empty").code == 0
    before = tree(tmp_path / "a")
    ran = cli("certify", "conflict.sleec", "-o", "a")
    assert (ran.code, "--force" in ran.err) == (2, True)
    assert tree(tmp_path / "a") == before
    assert cli("certify", "conflict.sleec", "-o", "a", "--force").code == 1
    assert cli("certify", "--check", "a", "conflict.sleec").code == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "clean.sleec", "conflict.sleec", "empty"]


def test_it_is_written_whole_or_not_at_all(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cli("certify", "clean.sleec", "-o", "a", files=FILES)
    before = tree(tmp_path)
    sound = Path.write_bytes

    def full(path: Path, data: bytes) -> int:
        if path.name == "manifest.json":
            raise OSError(28, "No space left on device")
        return sound(path, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    for command in (["-o", "b"], ["-o", "a", "--force"]):
        ran = cli("certify", "clean.sleec", *command)
        assert (ran.code, "No space left" in ran.err) == (2, True)
    assert tree(tmp_path) == before
    monkeypatch.setattr(Path, "write_bytes", sound)
    rename = Path.rename

    def refuse(path: Path, target: Path) -> Path:
        if path.name == "new":
            raise OSError(13, "Permission denied")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", refuse)
    assert cli("certify", "clean.sleec", "-o", "a", "--force").code == 2
    assert tree(tmp_path) == before

    def interrupt(path: Path, target: Path) -> Path:
        if path.name == "new":
            raise KeyboardInterrupt
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_folder(str(tmp_path / "a"), [("manifest.json", b"")], force=True)
    assert tree(tmp_path) == before


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["clean.sleec"], "use -o DIR"),
        (["clean.sleec", "-o", "a", "--check", "b"], "use -o DIR"),
        (["clean.sleec", "-o", "a", "--key", "k"], "--key needs --check"),
        (["clean.sleec", "-o", "a", "--checker", "k"], "--checker needs --check"),
        (["clean.sleec", "--check", "a", "--sign", "k"], "--sign needs -o"),
        (["clean.sleec", "--check", "a", "--force"], "--force needs -o"),
        (["clean.sleec", "--check", "a", "--checker", "nowhere"], "nowhere is not a program"),
        (["clean.sleec", "--check", "nowhere"], "nowhere is not a certificate"),
        (["clean.sleec", "-o", "a", "--domain", "kitchen"], "no rule has a domain"),
    ],
)
def test_usage(cli: Cli, arguments: list[str], said: str) -> None:
    ran = cli("certify", *arguments, files=FILES)
    assert said in " ".join(ran.err.split())
    assert ran.code == (0 if "--domain" in arguments else 2)


DOMAINS = "DOMAIN day\nRULE a WHEN A THEN X WITHIN 5 seconds\nDOMAIN night\nRULE b WHEN A THEN Y\n"


def test_a_certificate_checked_for_another_use(cli: Cli) -> None:
    def refused(*arguments: str) -> str:
        ran = cli("certify", "--check", *arguments)
        assert (ran.code, ran.out) == (2, "")
        return ran.err

    cli("certify", "clean.sleec", "-o", "a", files={**FILES, "domains.sleec": DOMAINS})
    assert "not for priority" in refused("a", "clean.sleec", "--reading", "priority")
    assert "not for the domain day" in refused("a", "clean.sleec", "--domain", "day")
    assert cli("certify", "--check", "a", "clean.sleec", "--untimed", "eventually").code == 0
    cli("certify", "domains.sleec", "-o", "b", "--domain", "day", "--reading", "priority", "--untimed", "eventually")
    said = refused("b", "domains.sleec")
    assert "the certificate is for the reading priority, not for cascade" in said
    assert "the certificate is for the domain day, not for each of the domains day, night" in said
    assert "the certificate is for --untimed eventually, not for at" in said
    use = ["--domain", "day", "--reading", "priority", "--untimed", "eventually"]
    assert cli("certify", "--check", "b", "domains.sleec", *use).code == 0
    for missing in (0, 2, 4):
        refused("b", "domains.sleec", *use[:missing], *use[missing + 2 :])


def test_what_a_certificate_is_for_is_printed(cli: Cli) -> None:
    def printed(file: str, *options: str) -> tuple[str, dict[str, object]]:
        """The first line, without the names of files; and the same for programs. Both are said again by --check."""
        head = cli("certify", file, "-o", "c", "--force", *options).out.split("\n")[0]
        checked = cli("certify", "--check", "c", file, *options).out.split("\n")[0]
        _, _, words = head.partition(" (")
        assert checked.endswith(f" ({words}")
        told = json.loads(cli("certify", "--check", "c", file, *options, "--format", "json").out)
        return words.rstrip(")"), {key: told[key] for key in ("reading", "domain", "untimed", "chains")}

    files = {**FILES, "domains.sleec": DOMAINS, "day.sleec": "DOMAIN day\nRULE a WHEN A THEN X\n"}
    cli("check", "clean.sleec", files=files)
    plain = {"reading": "cascade", "domain": None, "untimed": None, "chains": True}
    timed = {"reading": "cascade", "domain": None, "untimed": "at", "chains": True}
    assert printed("clean.sleec") == ("reading cascade; with chains", plain)
    made = cli("certify", "clean.sleec", "-o", "c", "--force", "--domain", "day", "--format", "json")
    assert json.loads(made.out)["domain"] is None
    assert printed("day.sleec") == ("reading cascade; domain day; with chains", plain)
    words = "reading cascade; each of the domains day, night; untimed at; with chains"
    assert printed("domains.sleec") == (words, timed)
    options = ("--domain", "night", "--reading", "priority", "--untimed", "eventually")
    words = "reading priority; domain night; untimed eventually; with chains"
    told = {"reading": "priority", "domain": "night", "untimed": "eventually", "chains": True}
    assert printed("domains.sleec", *options) == (words, told)
