"""Comments for random rulesets: what people leave above and behind lines, and what a parser may trip over."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st

from sleec_runtime.model import Clause, Comments, Rule, Statement


def comment_lines() -> st.SearchStrategy[tuple[str, ...]]:
    return st.lists(st.sampled_from(("", "why", "WHEN x", "// twice", "# ...", "äh, THEN")), max_size=3).map(tuple)


def _comments() -> st.SearchStrategy[Comments]:
    behind = st.sampled_from((None, None, "", "because", "UNLESS // not"))
    return st.builds(Comments, comment_lines(), behind)


@st.composite
def with_comments(draw: st.DrawFn, statement: Statement) -> Statement:
    statement = replace(statement, comments=draw(_comments()))
    if not isinstance(statement, Rule):
        return statement
    return replace(
        statement,
        default=draw(_commented_clause(statement.default)),
        hedges=tuple(draw(_commented_clause(hedge)) for hedge in statement.hedges),
    )


@st.composite
def _commented_clause(draw: st.DrawFn, clause: Clause) -> Clause:
    return replace(
        clause,
        comments=draw(_comments()),
        hedges=tuple(draw(_commented_clause(hedge)) for hedge in clause.hedges),
    )
