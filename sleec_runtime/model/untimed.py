"""What cannot keep times yet says so, before anything is done."""

from __future__ import annotations

# As `typing` has it; importing that would take longer than the rest.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset


def require_untimed(ruleset: Ruleset, who: str) -> None:
    """Raises UnsupportedTimes if `ruleset` holds times or relations; `who` is what cannot keep them."""
    if ruleset.is_timed:
        from sleec_runtime.model.time import refuse_times

        refuse_times(ruleset, who)
