"""Every text under `bad/` with all its problems, as `python -m tests.fast.language.test_bad_input` writes them down."""

from __future__ import annotations

from pathlib import Path

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import load

BAD = Path(__file__).with_name("bad")


def problems_of(path: Path) -> str:
    """The problems of a text, each with its place as ``line:column-line:column`` and its hint below."""
    with pytest.raises(LanguageError) as caught:
        load(path)
    lines = []
    for problem in caught.value.problems:
        place = caught.value.source.place(problem.span)
        where = f"{place.line}:{place.column}-{place.end_line}:{place.end_column}"
        lines.append(f"{where} {problem.message}\n    {problem.hint or '(no hint)'}\n")
    return "".join(lines)


@pytest.mark.parametrize("path", sorted(BAD.glob("*.sleec")), ids=lambda path: path.stem)
def test_problems_are_as_written_down(path: Path) -> None:
    assert problems_of(path) == path.with_suffix(".txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("path", sorted(BAD.glob("dsl-plain-*.txt")), ids=lambda path: path.stem)
def test_what_people_write_in_plain_words_is_told_with_what_helps(path: Path) -> None:
    assert "(no hint)" not in path.read_text(encoding="utf-8")


if __name__ == "__main__":
    for bad in sorted(BAD.glob("*.sleec")):
        bad.with_suffix(".txt").write_text(problems_of(bad), encoding="utf-8")
