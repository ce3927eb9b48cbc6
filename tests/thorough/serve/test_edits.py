"""A page that receives only changes has the same content as a page that requests everything, after any edits."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from tests.support.pages import assert_page_knows_what_is_new
from tests.support.text_edits import edited_texts


@pytest.mark.parametrize("timed", [False, True])
@pytest.mark.parametrize("seed", range(200, 206))
def test_random_edits(tmp_path: Path, seed: int, timed: bool) -> None:
    assert_page_knows_what_is_new(tmp_path, half_written(seed, timed))


def half_written(seed: int, timed: bool) -> Iterator[str]:
    """Edited texts, and now and then the beginning of one."""
    random = Random(seed)
    for text in edited_texts(seed, edits=6, timed=timed):
        if random.random() < 0.3:
            yield text[: random.randrange(len(text))]
        yield text
