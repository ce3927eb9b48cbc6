"""Concerns and purposes: what must not happen, and what must be able to happen."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from sleec_runtime.model.comments import NO_COMMENTS, Comments
from sleec_runtime.model.formula import Formula
from sleec_runtime.model.response import Clause
from sleec_runtime.support.spans import NOWHERE, Span

ClaimKind = Literal["concern", "purpose"]
CLAIM_KINDS: tuple[ClaimKind, ...] = ("concern", "purpose")
ClaimForm = Literal["exists", "when"]


@dataclass(frozen=True, slots=True)
class Claim:
    """A concern, which must never happen, or a purpose, which must be possible.

    ``label exists event and condition while responses[0] while …``, or ``label when event and condition then
    responses[0] while …``. `meanwhile` is a second claim, without a label, that must hold at some instant too.
    """

    kind: ClaimKind
    label: str
    form: ClaimForm
    event: str
    condition: Formula | None = None
    responses: tuple[Clause, ...] = ()
    meanwhile: Claim | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    label_span: Span = field(default=NOWHERE, compare=False, repr=False)
    event_span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)
