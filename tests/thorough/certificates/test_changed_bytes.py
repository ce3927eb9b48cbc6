"""A certificate of rules with time, with bytes of each of its files changed at random."""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fast.certificates.test_refused import copied, reasons, rehash
from tests.thorough.certificates.test_certificates import source, written

RULES = """RULE a WHEN A THEN X EVENTUALLY
RULE b WHEN B THEN NOT X WITHIN 3 seconds
RULE c WHEN B AND Dark THEN NOT X WITHIN 2 seconds
RULE d WHEN A THEN Y UNLESS Dark IN WHICH CASE Z UNLESS Dark AND Late IN WHICH CASE Z
RULE e WHEN C THEN Z WITHIN 2 seconds OTHERWISE Y
"""
CHANGES = 30


def change(data: bytes, draw: random.Random) -> bytes:
    """One byte replaced, removed, added or repeated, or two swapped."""
    place, other = draw.randrange(len(data)), draw.randrange(len(data))
    before, byte, after = data[:place], data[place : place + 1], data[place + 1 :]
    swapped = bytearray(data)
    swapped[place], swapped[other] = swapped[other], swapped[place]
    return draw.choice(
        [
            before + bytes([byte[0] ^ draw.randrange(1, 256)]) + after,
            before + after,
            before + bytes([draw.randrange(256)]) + byte + after,
            before + byte + byte + after,
            bytes(swapped),
        ]
    )


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("made")
    written(source(RULES, folder), folder / "c")
    return folder


FORMULAS = ("conflict", "redundant-rule", "redundant-hedge", "reading")
FILES = {
    "traces.json": "witness",
    "templates.json": "template",
    **{f"{check}.cnf": "clauses" for check in FORMULAS},
    **{f"{check}.lrat": "proof" for check in FORMULAS},
}
"""The files, with the reason for which a change is rejected if the hash in the manifest is that of the changed file."""


def changes(data: bytes, name: str) -> Iterator[bytes]:
    draw = random.Random(name)
    for _ in range(CHANGES):
        changed = change(data, draw)
        if changed != data:
            yield changed


def test_these_are_the_files(made: Path) -> None:
    assert {path.name for path in (made / "c").iterdir()} == {"manifest.json", *FILES}


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_a_change_of_any_byte_is_rejected(made: Path, tmp_path: Path, name: str) -> None:
    folder = copied(made, tmp_path)
    path = folder / "c" / name
    manifest = (folder / "c" / "manifest.json").read_bytes()
    refused = 0
    for changed in changes(path.read_bytes(), name):
        path.write_bytes(changed)
        assert "file-changed" in reasons(folder)
        rehash(folder)
        found = reasons(folder)
        # Another refutation of the same formula is accepted.
        assert found == {FILES[name]} or (not found and name.endswith(".lrat"))
        refused += bool(found)
        (folder / "c" / "manifest.json").write_bytes(manifest)
    assert refused > CHANGES / 2


def test_a_change_of_the_manifest_is_rejected(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    path = folder / "c" / "manifest.json"
    data = path.read_bytes()
    version = data.index(b'"version": ')
    for changed in changes(data, "manifest.json"):
        path.write_bytes(changed)
        # Another version of the tool is accepted.
        assert reasons(folder) or changed[:version] == data[:version]
