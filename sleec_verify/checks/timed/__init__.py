"""The checks of rules with time: the same questions, codes and explanations, asked of all traces instead of all
situations."""

from __future__ import annotations

from collections.abc import Mapping

from sleec_verify.checks.base import Check
from sleec_verify.checks.timed.conflict import CONFLICT
from sleec_verify.checks.timed.dead import DEAD_HEDGE
from sleec_verify.checks.timed.redundant import REDUNDANT_HEDGE, REDUNDANT_RULE
from sleec_verify.checks.timed.vacuous import VACUOUS_CONFLICT

TIMED: Mapping[str, Check] = {
    check.name: check for check in (CONFLICT, VACUOUS_CONFLICT, DEAD_HEDGE, REDUNDANT_RULE, REDUNDANT_HEDGE)
}
