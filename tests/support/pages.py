"""A page of the server, without a browser: requests as the page sends them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from starlette.testclient import TestClient

from sleec_verify.serve.application import application
from sleec_verify.serve.key import Key
from sleec_verify.serve.session import Session

PORT = 8123
KEY = Key(PORT, "5" * 64, "a" * 64)
TOKEN = KEY.token
ADDRESS = f"http://127.0.0.1:{PORT}"


class Page:
    """A page on the file `path`, with drafts beside it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        app = application(Session(str(path), str(path.parent / "drafts")), KEY)
        self.client = TestClient(app, base_url=ADDRESS, raise_server_exceptions=False)
        self.headers = {"X-Sleec-Token": TOKEN, "Origin": ADDRESS}

    def get(self, name: str) -> Any:
        answer = self.client.get(f"/api/{name}", headers=self.headers)
        assert answer.status_code == 200, answer.text
        return answer.json()

    def post(self, name: str, /, status: int = 200, **fields: object) -> Any:
        answer = self.client.post(f"/api/{name}", json=fields, headers=self.headers)
        assert answer.status_code == status, answer.text
        return answer.json()


def page_on(folder: Path, text: str = "WHEN DoorbellRings THEN OpenDoor\n") -> Page:
    """A page on a new file with this text."""
    path = folder / "rules.sleec"
    path.write_text(text, encoding="utf-8")
    return Page(path)


def completed(answer: Any, known: Any) -> Any:
    """The whole analysis of an answer to "check", for a page that knows the analysis before."""
    for parts, name in (("rules", "label"), ("findings", "id")):
        had = {one[name]: one for one in known[parts]}
        answer[parts] = [{**had.get(one[name], {}), **one} for one in answer[parts]]
    return {**answer, "names": {**known["names"], **answer["names"]}}


def assert_page_knows_what_is_new(folder: Path, texts: Iterable[str]) -> None:
    """Check one text after the other on a page that names the analysis that it has. What it then knows is what another
    page gets that asks for everything."""
    page, other = page_on(folder), page_on(folder)
    known = page.post("check", text="WHEN DoorbellRings THEN OpenDoor\n")
    other.post("check", text="WHEN DoorbellRings THEN OpenDoor\n")
    for text in texts:
        known = completed(page.post("check", text=text, since=known["version"]), known)
        whole = other.post("check", text=text)
        assert {**known, "version": "", "seconds": 0} == {**whole, "version": "", "seconds": 0}, text
