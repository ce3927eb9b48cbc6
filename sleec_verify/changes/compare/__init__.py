"""What changes between two rulesets: a comparison of what they mean, not of how they are written.

A context is compared where the assumptions of both sides allow it and neither side conflicts in it; there the sets of
literals that are due (Definition 1) are compared. Where only one side conflicts, or only one side allows the context,
that is told by itself. Rules that are equal on both sides cancel; only what is left is given to a solver.

Entry point: `compare`. The rest are the values that it returns.
"""

from __future__ import annotations

from sleec_verify.changes.compare.differences import compare
from sleec_verify.changes.compare.result import (
    Change,
    ConflictChange,
    DecidingClause,
    Difference,
    Extent,
    NameChange,
    Relation,
    SituationChange,
    Undecidable,
    by_obligation,
    relation,
)

__all__ = [
    "Change",
    "ConflictChange",
    "DecidingClause",
    "Difference",
    "Extent",
    "NameChange",
    "Relation",
    "SituationChange",
    "Undecidable",
    "by_obligation",
    "compare",
    "relation",
]
