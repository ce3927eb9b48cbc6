"""Cases and certificates that a change moves away from their rulesets, so that no policy asks for them any more."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence, Set

from sleec_runtime.model import NOWHERE, Source
from sleec_verify.changes.gate.examination import Locate
from sleec_verify.changes.gate.result import POLICY_CHANGES, Block
from sleec_verify.changes.revisions.versions import Versions
from sleec_verify.files.folders import beside
from sleec_verify.results.finding import Finding

KINDS = {".cases.toml": "the cases of {} are missing", ".certificate": "the certificate of {} is missing"}


def lost_evidence(
    versions: Sequence[Versions], before: Mapping[str, str], files: Set[str], locate: Locate
) -> Iterator[Block]:
    """What the base has beside a ruleset, and the change has not. `files` are the paths of the base, and `before` the
    old paths of rulesets that have moved. Linear."""
    folders = {path.rpartition("/")[0] for path in files}
    for one in versions:
        if one.old is None or one.new is None:
            continue
        for suffix, message in KINDS.items():
            had = beside(before.get(one.path, one.path), suffix)
            if (had in files or had in folders) and not os.path.lexists(locate(beside(one.path, suffix))):
                what = f"{message.format(one.path)}: the base has {had}"
                finding = Finding(POLICY_CHANGES, POLICY_CHANGES, "error", what, NOWHERE, source=Source(one.path, ""))
                yield Block(POLICY_CHANGES, one.path, what, finding)
