"""Who may use the server: only a page that it served itself, in a browser on this machine.

Every web page in the user's browser can send requests to this machine. The random token keeps them out, and so do the
checks of `Host` (against DNS rebinding) and `Origin`. The content security policy keeps scripts in names and comments
from running.
"""

from __future__ import annotations

from hmac import compare_digest
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from sleec_verify.serve.key import Key

TOKEN_HEADER = "x-sleec-token"

RESUMPTION = "/api/resumption"
"""The request of a page whose token is out of date, because the server was started again."""

LARGEST_BODY = 32 * 2**20
"""Bytes of a request. A comparison has two texts, and JSON may escape each character."""

_HEADERS = {
    "content-security-policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}

_REFUSED = """<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>sleec-verify</title></head>
<body><h1>This address does not work</h1><p>The reason: {reason}.</p><p>To continue, {hint}.</p></body>
</html>
"""
"""What a browser shows in place of the page."""


class TooLarge(Exception):
    """The body of a request is larger than `LARGEST_BODY`."""


class Access:
    """Accepts only requests that come from the page at the port and have the token. Adds headers to each response.

    The files of the page, below ``/assets/``, need no token, because they are the same for everyone. The answer to
    `RESUMPTION` is of use only to those who know the secret.
    """

    def __init__(self, app: ASGIApp, key: Key) -> None:
        self._app = app
        self._token = key.token.encode()
        self._hosts = (f"127.0.0.1:{key.port}", f"localhost:{key.port}")

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(_HEADERS)
            await send(message)

        reason = self._refusal(scope)
        if reason is not None:
            hint = "open the address that the command printed last"
            answer: Response = JSONResponse({"message": reason, "hint": hint}, 403)
            if scope["path"] == "/":
                answer = HTMLResponse(_REFUSED.format(reason=reason, hint=hint), 403)
            await answer(scope, receive, send_with_headers)
            return
        try:
            await self._app(scope, _limited(receive), send_with_headers)
        except TooLarge:
            answer = JSONResponse(
                {"message": f"the request is larger than {LARGEST_BODY >> 20} MiB", "hint": None}, 413
            )
            await answer(scope, receive, send_with_headers)

    def _refusal(self, scope: Scope) -> str | None:
        headers = Headers(scope=scope)
        if headers.getlist("host") not in ([host] for host in self._hosts):
            return "the server accepts only requests to this machine"
        if any(origin not in [f"http://{host}" for host in self._hosts] for origin in headers.getlist("origin")):
            return "the request comes from a page of another origin"
        if scope["path"].startswith("/assets/") or scope["path"] == RESUMPTION:
            return None
        if scope["path"] == "/":
            given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [])
        else:
            given = headers.getlist(TOKEN_HEADER)
        if len(given) != 1 or not compare_digest(given[0].encode("utf-8", "replace"), self._token):
            return "the token is missing or wrong"
        return None


def _limited(receive: Receive) -> Receive:
    size = 0

    async def limited() -> Message:
        nonlocal size
        message = await receive()
        size += len(message.get("body", b""))
        if size > LARGEST_BODY:
            raise TooLarge
        return message

    return limited
