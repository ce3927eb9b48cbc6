"""Comparison of two rulesets by meaning, not by text (docs/comparison.md).

A context counts if the assumptions of both sides allow it and neither side conflicts in it. There, the sets of due
literals (Definition 1) are compared. If only one side conflicts, or only one side allows the context, this is a
separate entry. So is a conflict over time that only one side has. Rules that are equal on both sides cancel out. Only
the others need a solver.
"""

from __future__ import annotations

from sleec_verify.changes.compare.differences import compare
from sleec_verify.changes.compare.result import (
    Change,
    ConflictChange,
    ConstraintChange,
    DecidingClause,
    Difference,
    Extent,
    NameChange,
    Relation,
    SituationChange,
    TimedConflictChange,
    Undecidable,
    by_obligation,
    relation,
)

__all__ = [
    "Change",
    "ConflictChange",
    "ConstraintChange",
    "DecidingClause",
    "Difference",
    "Extent",
    "NameChange",
    "Relation",
    "SituationChange",
    "TimedConflictChange",
    "Undecidable",
    "by_obligation",
    "compare",
    "relation",
]
