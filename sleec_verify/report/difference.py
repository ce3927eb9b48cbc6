"""What `diff` says, in each of its formats."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from sleec_verify.report import difference_concise, difference_full, difference_json

if TYPE_CHECKING:
    from sleec_verify.report.difference_report import DifferenceReport
    from sleec_verify.report.palette import Palette

RENDERERS: Mapping[str, Callable[[DifferenceReport, Palette], Iterator[str]]] = {
    "full": difference_full.render,
    "concise": difference_concise.render,
    "json": difference_json.render,
}
