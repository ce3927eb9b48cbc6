"""Broken entries of the cache are decided again."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from sleec_verify.cli.cache import entry as entry_of_cache
from tests.support.caches import CLASH, entries
from tests.support.cli import Cli


def flip(position: int) -> Callable[[bytes], bytes]:
    def broken(content: bytes) -> bytes:
        at = position % len(content)
        return content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :]

    return broken


BREAKS: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _: b"",
    "cut": lambda content: content[: len(content) // 2],
    "binary": lambda _: bytes(range(256)) * 4,
    "no hash": lambda content: content.partition(b"\n")[2],
    "older format": lambda content: content.replace(b"cache 2", b"cache 1"),
    "first bit": flip(0),
    "bit of the hash": flip(40),
    "bit of the body": flip(150),
    "last bit": flip(-1),
    "green": lambda content: content.replace(b"SLEEC101", b"SLEEC503"),
    "more": lambda content: content + b"\n",
}


@pytest.mark.parametrize("name", BREAKS)
def test_a_broken_entry_is_decided_anew(name: str, folder: Path, cli: Cli, solves: Callable[[], int]) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    content = entry.read_bytes()
    entry.write_bytes(BREAKS[name](content))
    solves()
    ran = cli("check", "a.sleec")
    assert solves() == 1
    assert (ran.code, ran.out) == (sound.code, sound.out)
    assert f"note: the cache entry {entry} is damaged; its results are recomputed\n" in ran.err
    assert cli("check", "a.sleec") == sound
    assert solves() == 0


def test_an_entry_under_another_name_is_none(folder: Path, cli: Cli) -> None:
    """That these rules are fine vouches for no others."""
    cli("check", "fine.sleec", files={"fine.sleec": "WHEN Rung THEN Open\n"})
    (fine,) = entries(folder)
    cli("check", "a.sleec", files={"a.sleec": CLASH})
    (clash,) = (path for path in entries(folder) if path != fine)
    clash.write_bytes(fine.read_bytes())
    ran = cli("check", "a.sleec")
    assert ran.code == 1
    assert "is damaged" in ran.err


@pytest.mark.skipif(os.name != "posix", reason="pipes and devices are those of POSIX")
def test_what_is_no_file_is_no_entry(folder: Path, cli: Cli) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    for make in (
        lambda: os.mkfifo(entry),
        lambda: entry.symlink_to("/dev/zero"),
        lambda: entry.symlink_to(entry),
        lambda: entry.symlink_to("nowhere"),
    ):
        entry.unlink()
        make()
        assert cli("check", "a.sleec") == sound
        assert entry.is_file(), "it was put in place again"
        assert not entry.is_symlink()


@pytest.mark.parametrize("in_place_of", ["entry", "its folder", "all"])
def test_a_folder_or_file_in_the_wrong_place_is_told_of(in_place_of: str, folder: Path, cli: Cli) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    entry.unlink()
    if in_place_of == "entry":
        entry.mkdir()
    elif in_place_of == "its folder":
        entry.parent.rmdir()
        entry.parent.write_text("")
    else:
        shutil.rmtree(folder)
        folder.write_text("")
    ran = cli("check", "a.sleec")
    if in_place_of == "all":
        assert (ran.code, "which is not a folder" in ran.err) == (2, True)
    else:
        assert (ran.code, ran.out) == (sound.code, sound.out)
        assert f"note: the cache folder {folder} cannot be written: " in ran.err


def test_a_hash_that_fits_makes_no_sense_of_nonsense(folder: Path, cli: Cli) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    for body in (
        b"[]]",
        b"[(1, 2)]",
        b"__import__('os').abort()",
        b"(" * 100_000,
        b"[('x', 0.0, None, [{}])]",
        b"\xff",
    ):
        entry.write_bytes(entry_of_cache.head(str(entry), body) + b"\n" + body)
        ran = cli("check", "a.sleec")
        assert (ran.code, ran.out) == (sound.code, sound.out)
        assert "is damaged" in ran.err
