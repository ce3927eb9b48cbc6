"""Values of parameters that no program should give."""

from __future__ import annotations

from decimal import Decimal

NO_SECONDS: tuple[object, ...] = (
    *(0, -1, 1e-9, 5e-324, float("nan"), float("inf"), 1e300, 10**13, 10**400, 10**5_000),
    *(Decimal("NaN"), Decimal("1e-30"), True, None, "1", [1], 1j),
)
"""Not a length of time that a node can measure."""
