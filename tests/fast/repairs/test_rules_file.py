"""Edits of the bytes of a file: what the parser reads is the edited text, and all other bytes stay."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sleec_runtime.language.common.source import decode_source
from sleec_verify.repairs.edit import TextEdit, edited, in_order
from sleec_verify.repairs.rules_file import FileChanged, RulesFile

WORDS = st.text("aé🌅", min_size=1, max_size=3)
BREAKS = st.sampled_from(["\n", "\r\n", "\r"])


def file_of(text: str) -> RulesFile:
    content = text.encode()
    return RulesFile("a.sleec", sha256(content).hexdigest(), content)


@given(st.lists(st.tuples(WORDS, BREAKS), min_size=1, max_size=6), st.booleans(), st.data())
def test_edited_bytes_are_the_edited_text(lines: list[tuple[str, str]], has_mark: bool, data: st.DataObject) -> None:
    body = "".join(f"{word}{line_break}" for word, line_break in lines)
    mark = "\ufeff" * has_mark
    raw = f"{mark}{body}"
    text = decode_source("a.sleec", raw.encode()).text
    borders = [0, *(n for n in range(1, len(body)) if not {body[n - 1], body[n]} & {"\r", "\n"}), len(body)]
    chosen = sorted(data.draw(st.lists(st.sampled_from(borders), min_size=2, max_size=2, unique=True)))
    new = data.draw(st.sampled_from(["", "b", "b\nc", "\n"]))
    assume(new or body[chosen[0] : chosen[1]])
    edits = in_order([TextEdit(chosen[0], chosen[1], new)])
    after = file_of(raw).edited(edits)
    assert after.text == edited(text, edits)
    content = after.content.decode()
    assert content.startswith(f"{mark}{body[: chosen[0]]}")
    assert content.endswith(body[chosen[1] :])
    assert len(content) == len(mark) + len(edited(text, edits))


def test_a_file_of_other_bytes_is_not_written(tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_bytes(b"old")
    file = RulesFile(str(path), sha256(b"old").hexdigest(), b"new")
    path.write_bytes(b"mine")
    with pytest.raises(FileChanged, match="was changed since the check"):
        file.write()
    assert path.read_bytes() == b"mine"
    path.write_bytes(b"old")
    assert file.write().sha256 == sha256(b"new").hexdigest()
    assert path.read_bytes() == b"new"
