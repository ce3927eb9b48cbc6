"""The output of `diff` for programs: one JSON object (docs/schema/diff.schema.json)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify import __version__
from sleec_verify.changes.assertions.assertion import Violation
from sleec_verify.changes.compare import by_obligation
from sleec_verify.results.json_values import dump, error_json, finding_json, span_json, witness_json
from sleec_verify.wording.phrases import in_short

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.compare import (
        Change,
        ConflictChange,
        DecidingClause,
        Difference,
        Extent,
        SituationChange,
    )
    from sleec_verify.report.difference_report import DifferenceReport, RulesetDifference
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.json_values import Json


def render(report: DifferenceReport, palette: Palette) -> Iterator[str]:
    """All results as one object."""
    del palette  # a program reads this
    found = report.differences
    yield dump(
        {
            "tool": {"name": "sleec-verify", "version": __version__},
            "relation": report.relation,
            "changes": [
                {
                    "obligation": str(obligation),
                    "change": way,
                    **({} if obligation.timing is None else {"when": str(obligation.timing)}),
                    **_cause(one, change),
                }
                for one in found
                for change, obligation, way in by_obligation(one.changes)
            ],
            "conflicts": [
                {
                    "change": conflict.way,
                    "obligations": [str(o) for o in conflict.literals],
                    **_cause(one, conflict),
                }
                for one in found
                for conflict in one.conflicts
            ],
            "timed_conflicts": [
                {
                    "change": conflict.way,
                    "finding": finding_json(conflict.finding, (one.new if conflict.way == "added" else one.old).source),
                    "domains": list(conflict.domains),
                    "ruleset": one.new.source.path,
                }
                for one in found
                for conflict in one.timed_conflicts
            ],
            "situations": [_situation_json(one, situation) for one in found for situation in one.situations],
            "names": [
                {"change": name.way, "kind": name.kind, "name": name.name, "ruleset": one.new.source.path}
                for one in found
                for name in one.names
            ],
            "unknown": [
                {"what": what, "why": why, "ruleset": one.new.source.path}
                for one in found
                for what, why in one.undecided
            ],
            "rulesets": [_compared_json(one) for one in report.compared],
            "assertions": [_asked_json(one) for one in report.asked],
            "summary": {
                "rulesets": len(report.compared) + report.unchanged,
                "unchanged": report.unchanged,
                "added": sum(len(change.added) for one in found for change in one.changes),
                "removed": sum(len(change.removed) for one in found for change in one.changes),
                "new_conflicts": sum(
                    conflict.way == "added" for one in found for conflict in (*one.conflicts, *one.timed_conflicts)
                ),
            },
        }
    )


def _cause(found: Difference, one: Change | ConflictChange) -> dict[str, Json]:
    return {
        "rules": list(one.rules),
        "witness": witness_json(one.witness),
        "before": _deciding_json(one.before, found.old),
        "after": _deciding_json(one.after, found.new),
        "situations": _extent_json(one.extent),
        "domains": list(one.domains),
        "ruleset": found.new.source.path,
    }


def _deciding_json(deciding: Sequence[DecidingClause], ruleset: Ruleset) -> Json:
    return [
        {
            "rule": one.rule,
            "clause": one.clause,
            "obligations": [in_short(o) for o in one.obligations],
            "span": span_json(one.span, ruleset.source),
        }
        for one in deciding
    ]


def _extent_json(extent: Extent) -> Json:
    return {
        "affected": extent.affected,
        "possible": extent.possible,
        "given": list(extent.given),
        "over": [{"names": [name for _, name in part.names], "ways": part.ways} for part in extent.over],
        "reason": extent.why,
    }


def _situation_json(found: Difference, one: SituationChange) -> Json:
    return {
        "change": one.way,
        "granted": one.what,
        "witness": None if one.witness is None else witness_json(one.witness),
        "situations": None if one.extent is None else _extent_json(one.extent),
        "domains": list(one.domains),
        "ruleset": found.new.source.path,
    }


def _compared_json(one: RulesetDifference) -> Json:
    if one.difference is None:
        return {"path": one.path, "errors": [error_json(error) for error in one.errors]}
    found = one.difference
    return {
        "path": one.path,
        "relation": found.relation,
        "old": _ruleset_json(found.old),
        "new": _ruleset_json(found.new),
        "same": found.same,
        "renamed": [{"old": old, "new": new} for old, new in found.renamed],
        "rewritten": [labels[-1] for labels in found.rewritten],
        "reordered": found.reordered,
        "notes": list(found.notes),
    }


def _ruleset_json(ruleset: Ruleset) -> Json:
    return {
        "path": ruleset.source.path,
        "sha256": ruleset.source.sha256,
        "syntax": ruleset.syntax,
        "reading": ruleset.reading,
        "rules": len(ruleset.rules),
    }


def _asked_json(asked: AssertionResult) -> Json:
    assertion, ruleset, answer = asked
    broken = answer if isinstance(answer, Violation) else None
    return {
        "assertion": assertion.text,
        "holds": None if isinstance(answer, str) else broken is None,
        "reason": answer if isinstance(answer, str) else None,
        "witness": None if broken is None else witness_json(broken.witness),
        "because": [] if broken is None else _deciding_json(broken.deciding, ruleset),
        "domain": None if broken is None else broken.domain,
        "ruleset": ruleset.source.path,
    }
