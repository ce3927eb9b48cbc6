"""The relation of rules with time against brute force: stricter rules are kept by fewer traces."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from sleec_verify.changes.compare import Relation, compare, relation
from tests.support.timed_pairs import edit_of, kept, random_rule, relation_of_traces

INCLUSIONS = {"equivalent": (True, True), "stricter": (False, True), "laxer": (True, False)}
"""Whether each trace that keeps the old rules keeps the new ones, and the reverse."""


def _relation(old: str, new: str) -> Relation:
    """The relation without regard to conflicts between several triggerings."""
    found = compare(parse(old), parse(new))
    return relation(found.more, found.less, bool(found.conflicts), bool(found.undecided))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_clauses_of_one_response_are_compared_exactly(seed: int) -> None:
    random = Random(seed)
    old = random_rule(random, conjunctions=False)
    new = edit_of(random, old, conjunctions=False)
    assert _relation(old, new) == relation_of_traces(old, new), (old, new)


@pytest.mark.parametrize("seed", range(40))
def test_what_is_stricter_is_kept_by_no_other_traces(seed: int) -> None:
    """Responses of one clause may imply another one together, so `compare` may find changes without an effect."""
    random = Random(seed)
    old = random_rule(random, conjunctions=True)
    new = edit_of(random, old, conjunctions=True)
    more, less = INCLUSIONS.get(_relation(old, new), (False, False))
    assert not more or kept(old) <= kept(new), (old, new)
    assert not less or kept(new) <= kept(old), (old, new)
