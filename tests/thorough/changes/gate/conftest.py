"""A repository with one ruleset, and a folder outside of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.gate_policies import SECRET
from tests.support.gates import OLD
from tests.support.repository import Repository


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.commit(a_sleec=OLD)
    return made


@pytest.fixture
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("outside")
    (made / "secret").write_text(SECRET)
    return made
