"""What is built from proofs/ needs Coq: without it tests are skipped, with the reason, but never in CI."""

from __future__ import annotations

import os
import shutil

import pytest


def require_coq(what: str) -> None:
    """Skips where `what` cannot be built, but fails in CI."""
    missing = [tool for tool in ("coqc", "ocamlfind", "make") if shutil.which(tool) is None]
    if missing:
        reason = f"{what} cannot be built without {' and '.join(missing)} (apt-get install coq ocaml-findlib)"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
