"""Random formulas, and whether they have a model by trying everything."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from hypothesis import strategies as st

from sleec_verify.certificates.recorder import RecordedQuestion

MOST = 6
"""Variables, so that every assignment can be tried."""

literals = st.integers(1, MOST).flatmap(lambda v: st.sampled_from((v, -v)))


def clauses() -> st.SearchStrategy[list[list[int]]]:
    """Clauses of three literals mostly, some longer, shorter, empty, with repeats or opposites in them."""
    one = st.one_of(st.lists(literals, min_size=2, max_size=3), st.lists(literals, max_size=4))
    return st.lists(one, max_size=30)


questions = st.lists(st.lists(literals, max_size=3).map(tuple), min_size=1, max_size=3, unique=True)


def asked() -> st.SearchStrategy[list[RecordedQuestion]]:
    """Formulas with questions, whatever the answers."""
    one = st.builds(lambda c, q: RecordedQuestion(c, dict.fromkeys(q, "")), clauses(), questions)
    return st.lists(one, max_size=3)


def has_model(formula: Sequence[Sequence[int]], variables: int = MOST) -> bool:
    """Whether some assignment of these variables makes a literal of each clause true."""
    return any(
        all(any(values[abs(literal) - 1] == (literal > 0) for literal in clause) for clause in formula)
        for values in product((False, True), repeat=variables)
    )


def some_question_has_model(all_asked: Sequence[RecordedQuestion]) -> bool:
    asked_of = ((one.clauses, question) for one in all_asked for question in one.questions)
    return any(has_model([*formula, *([literal] for literal in question)]) for formula, question in asked_of)
