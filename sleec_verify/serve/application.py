"""The HTTP application: routes, errors, and the files of the page."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from sleec_runtime.errors import LanguageError, SleecError
from sleec_verify.results.internal_error import internal_errors_of
from sleec_verify.results.json_values import Json
from sleec_verify.serve.access import RESUMPTION, Access
from sleec_verify.serve.answers import documents
from sleec_verify.serve.answers.cases import add_case, cases, run_cases
from sleec_verify.serve.answers.check import check, problems_json
from sleec_verify.serve.answers.compare import compare
from sleec_verify.serve.answers.repairs import repairs
from sleec_verify.serve.answers.search import search
from sleec_verify.serve.answers.situation import situation
from sleec_verify.serve.answers.timeline import timeline
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.interest import Superseded, watched
from sleec_verify.serve.key import Key
from sleec_verify.serve.rules_file import ChangedOnDisk
from sleec_verify.serve.session import Session, UnknownText
from sleec_verify.wording.phrases import error_summary
from sleec_verify.wording.translation import LANGUAGES, Language, translated

PAGE = Path(__file__).parent / "page"
"""The built front end. Its source is in ``frontend/``."""

Answer = Callable[[Session, Body], dict[str, Json]]

READS: Mapping[str, Answer] = {"file": documents.file, "disk": documents.disk, "cases": cases}
"""The requests without a body, below ``/api/``."""

ACTS: Mapping[str, Answer] = {
    "save": documents.save,
    "draft": documents.draft,
    "check": check,
    "situation": situation,
    "search": search,
    "repairs": repairs,
    "compare": compare,
    "timeline": timeline,
    "cases": cases,
    "cases/add": add_case,
    "cases/run": run_cases,
}
"""The requests with a JSON object as their body, below ``/api/``."""


class _Answer(JSONResponse):
    """A response in ASCII, because the name of a file may not be text in UTF-8."""

    def render(self, content: object) -> bytes:
        return json.dumps(content, allow_nan=False, separators=(",", ":")).encode()


def application(session: Session, key: Key) -> Starlette:
    """The application for a server with a key, for pages that know its token."""
    app = Starlette(
        routes=[
            Route("/", _page),
            Route(RESUMPTION, partial(_resumption, key)),
            Route("/api/secret", partial(_secret, key)),
            Mount("/assets", StaticFiles(directory=PAGE / "assets", check_dir=False)),
            *(Route(f"/api/{name}", _endpoint(session, answer), methods=["GET"]) for name, answer in READS.items()),
            *(Route(f"/api/{name}", _endpoint(session, answer), methods=["POST"]) for name, answer in ACTS.items()),
        ],
        middleware=[Middleware(Access, key=key)],
        exception_handlers={HTTPException: _http_error},
    )
    app.router.redirect_slashes = False
    return app


async def _page(request: Request) -> Response:
    del request
    return FileResponse(PAGE / "index.html")


async def _resumption(key: Key, request: Request) -> Response:
    """What a page needs to continue after a restart, if it knows the secret."""
    challenge = request.query_params.get("challenge", "")[:64]
    return JSONResponse({"salt": key.salt, "response": key.response(challenge)})


async def _secret(key: Key, request: Request) -> Response:
    del request
    return JSONResponse({"secret": key.secret})


def _endpoint(session: Session, answer: Answer) -> Callable[[Request], object]:
    async def endpoint(request: Request) -> Response:
        content = await request.body()
        async with watched(request):
            return await run_in_threadpool(respond, session, answer, content)

    return endpoint


def respond(session: Session, answer: Answer, content: bytes) -> Response:
    """The response to a request with this body. An error is an object with its message and hint."""
    try:
        with internal_errors_of(session.file.path):
            try:
                body = Body.read(content or b"{}")
                language = _language(body)
                found: Json = answer(session, body)
                return _Answer(found if language == "en" else _translated(found, language))
            except Superseded:
                return Response(status_code=204)
    except ChangedOnDisk as error:
        return _Answer({**_error(error), **error.state._asdict()}, 409)
    except UnknownText as error:
        return _Answer(_error(error), 410)
    except SleecError as error:
        return _Answer(_error(error), 400)


def _language(body: Body) -> Language:
    """The language of the sentences for people: the field ``language``, otherwise English."""
    wanted = body.text_or_none("language") or "en"
    for language in LANGUAGES:
        if language == wanted:
            return language
    raise BadRequest("the page does not have this language", f"the languages are {', '.join(LANGUAGES)}")


def _translated(answer: Json, language: Language) -> Json:
    if isinstance(answer, str):
        return translated(answer, language)
    if isinstance(answer, list):
        return [_translated(one, language) for one in answer]
    return {key: _translated(one, language) for key, one in answer.items()} if isinstance(answer, dict) else answer


def _error(error: SleecError) -> dict[str, Json]:
    problems = {"problems": problems_json(error)} if isinstance(error, LanguageError) else {}
    return {"message": error_summary(error), "hint": error.hint, **problems}


async def _http_error(request: Request, error: Exception) -> Response:
    del request
    assert isinstance(error, HTTPException), "it is the handler of these"
    return JSONResponse({"message": error.detail, "hint": None}, error.status_code)
