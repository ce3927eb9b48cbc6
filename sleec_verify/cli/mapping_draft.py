"""``sleec-verify audit --suggest-mapping``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from sleec_verify.audit.readers.forms import open_log
from sleec_verify.audit.suggestion.draft import draft
from sleec_verify.audit.suggestion.log_topics import Topic, topics_of
from sleec_verify.cli import exits
from sleec_verify.cli.output import tell, write_data
from sleec_verify.files.placement import write_new
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset


def suggest_mapping(logs: Sequence[str], ruleset: Ruleset, output: str | None) -> int:
    """Writes a draft of a mapping to standard output, or to a new file `output`.

    Raises:
        SleecError: a log cannot be read, or `output` exists.
    """
    topics: dict[str, Topic] = {}
    for log in reversed(logs):  # the first log that has a topic takes precedence
        topics.update(topics_of(open_log(Path(log))))
    text = draft(topics, ruleset, ", ".join(logs))
    if output is None:
        write_data((text,))
    else:
        write_new(output, text.encode())
        active = sum("  # likely, " in line for line in text.splitlines() if not line.startswith("#"))
        names = f"{counted(active, 'name')} of the rules {'has' if active == 1 else 'have'} a likely meaning"
        tell(f"{output}: {names}; check each line, and fill in the others")
    return exits.HOLDS
