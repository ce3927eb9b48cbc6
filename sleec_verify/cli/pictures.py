"""The option ``--svg`` of ``sleec-verify check``."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from itertools import count
from typing import TYPE_CHECKING
from unicodedata import normalize

from sleec_runtime.errors import SleecError
from sleec_verify.report.outcome import CheckedRuleset

if TYPE_CHECKING:
    from sleec_verify.wording.translation import Language


_LONGEST = 80
"""The bytes of a name in the name of a file."""


def write_pictures(outcomes: Sequence[CheckedRuleset], folder: str, language: Language) -> int:
    """Write the pictures of rulesets into a folder, which is made if it is not there. Files of these names are
    overwritten. Returns the number of files.

    Raises:
        SleecError: the folder or a file cannot be written.
    """
    from sleec_verify.files.placement import write_whole

    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise SleecError(f"{folder} cannot be made: {error.strerror}", "name a folder that you can write to") from None
    used: set[str] = set()
    for outcome in outcomes:
        stem = _file_name(os.path.splitext(os.path.basename(outcome.ruleset.source.path))[0])
        for name, picture in _pictures(outcome, language):
            file = _unused(f"{stem}-{name}", used)
            write_whole(os.path.join(folder, f"{file}.svg"), picture.encode())
    return len(used)


def _pictures(outcome: CheckedRuleset, language: Language) -> Iterator[tuple[str, str]]:
    """The name and the text of each picture of a ruleset."""
    from sleec_verify.report.pictures.rule_flow import rule_flow
    from sleec_verify.report.pictures.rule_graph import rule_graph
    from sleec_verify.report.pictures.timeline import timeline_picture

    ruleset = outcome.ruleset
    if not ruleset.rules:
        return
    yield "graph", rule_graph(ruleset, language)
    for rule in ruleset.rules:
        yield f"rule-{_file_name(rule.label)}", rule_flow(rule, ruleset.reading, language)
    for finding in outcome.deduplicated:
        if finding.timeline is not None:
            yield f"timeline-{finding.code}", timeline_picture(finding.timeline, finding.message, language)


def _file_name(name: str) -> str:
    """A name as a part of a file name, on every system. File systems allow 255 bytes for the whole."""
    cleaned = re.sub(r"[^\w-]", "_", name)
    return cleaned.encode()[:_LONGEST].decode(errors="ignore") or "rules"


def _unused(file: str, used: set[str]) -> str:
    """`file`, with a number if a file system cannot tell it from one in `used`: some ignore the case, or how letters
    with accents are coded."""
    numbered = (f"{file}-{number}" if number > 1 else file for number in count(1))
    found = next(one for one in numbered if _compared(one) not in used)
    used.add(_compared(found))
    return found


def _compared(file: str) -> str:
    return normalize("NFKC", normalize("NFKC", file).casefold())
