"""Answers about the file itself: its text, its state on disk, saving, and the draft."""

from __future__ import annotations

import os

from sleec_runtime.errors import LanguageError
from sleec_verify.results.json_values import Json
from sleec_verify.serve.body import Body
from sleec_verify.serve.drafts import Draft
from sleec_verify.serve.session import Session


def file(session: Session, body: Body) -> dict[str, Json]:
    """The file, and its draft if that differs from it."""
    del body
    state = session.file.state()
    kept = session.drafts.read()
    if kept is not None and kept.text == state.text:
        kept = None
    text = state.text or ""
    try:
        ruleset = session.ruleset(text)
    except LanguageError:
        ruleset = None
    path = session.file.path
    return {
        "path": path,
        "name": os.path.basename(path),
        "syntax": None if ruleset is None else ruleset.syntax,
        "text": text,
        "sha256": state.sha256,
        "problem": state.problem,
        "draft": None if kept is None else {"text": kept.text, "based_on": kept.based_on},
        "cases": str(session.cases.path) if session.cases.exists() else None,
        "domains": [] if ruleset is None else list(ruleset.domains),
    }


def disk(session: Session, body: Body) -> dict[str, Json]:
    """The digests of the file and of the cases now, for a page that asks whether they have changed."""
    del body
    state = session.file.state()
    return {"sha256": state.sha256, "problem": state.problem, "cases": session.cases.digest()}


def save(session: Session, body: Body) -> dict[str, Json]:
    """Save the text. Raises `ChangedOnDisk` if the file is not the one on which it is based."""
    digest = session.file.save(body.text("text"), body.text_or_none("based_on"))
    session.drafts.forget()
    return {"sha256": digest}


def draft(session: Session, body: Body) -> dict[str, Json]:
    """Keep the text as a draft."""
    session.drafts.keep(Draft(body.text("text"), body.text_or_none("based_on")))
    return {}
