"""Documents as those of the command line, about robots' code; see tests/fast/cli/test_documents.py."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fast.cli.test_documents import test_document as run
from tests.support.cli import Cli

FOLDER = Path(__file__).parent / "documents"
DOCUMENTS = sorted(FOLDER.rglob("*.txt"))


@pytest.mark.parametrize("path", DOCUMENTS, ids=[str(p.relative_to(FOLDER).with_suffix("")) for p in DOCUMENTS])
def test_document(path: Path, cli: Cli) -> None:
    run(path, cli)
