"""The answer to "check": problems of the text, or its names, rules and findings."""

from __future__ import annotations

from hashlib import sha256
from time import perf_counter

from sleec_runtime.errors import LanguageError
from sleec_verify.results.json_values import Json
from sleec_verify.serve.analysis import Analysis
from sleec_verify.serve.body import Body
from sleec_verify.serve.session import Session


def check(session: Session, body: Body) -> dict[str, Json]:
    """The analysis of the text. If the text is not a ruleset: its problems, with the analysis of the last text that
    was one. `of` is the digest of the text of the analysis, or null. `since` is the version of the analysis that the
    page has: what that has, too, is left out."""
    started = perf_counter()
    text = body.text("text")
    digest = sha256(text.encode()).hexdigest()
    problems: list[Json] = []
    analysis: Analysis | None
    try:
        analysis = session.analysis(text, digest)
    except LanguageError as error:
        problems = problems_json(error)
        analysis = session.last_analysis
    answer = _NOTHING if analysis is None else _since(session, body, analysis)
    return {**answer, "sha256": digest, "problems": problems, "seconds": round(perf_counter() - started, 6)}


_NOTHING: dict[str, Json] = {
    "of": None,
    "version": None,
    "names": {"triggers": [], "conditions": [], "obligations": []},
    "rules": [],
    "findings": [],
    "checks": [],
    "verdict": None,
}
"""The analysis before the first text that is a ruleset."""


def _since(session: Session, body: Body, analysis: Analysis) -> dict[str, Json]:
    """The analysis without what the page has in its language."""
    language = body.text_or_none("language") or "en"
    version, _, spoken = (body.text_or_none("since") or "").partition(" ")
    known = session.analysis_of_page(version) if spoken == language else None
    return {**analysis.json(known), "version": f"{analysis.version} {language}"}


def problems_json(error: LanguageError) -> list[Json]:
    """The problems of a text that is not a ruleset, with their places."""
    return [
        {"message": one.message, "hint": one.hint, "start": one.span.start, "end": one.span.end}
        for one in error.problems
    ]
