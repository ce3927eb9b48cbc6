"""Only the page that the server served itself gets answers."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from sleec_verify.serve import access
from tests.support.pages import ADDRESS, TOKEN, page_on

TOKENS = {"X-Sleec-Token": TOKEN}


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"X-Sleec-Token": ""},
        {"X-Sleec-Token": TOKEN[:-1]},
        {"X-Sleec-Token": "\xe9"},
        {**TOKENS, "Host": "evil.example:8123"},
        {**TOKENS, "Host": "127.0.0.1:1"},
        {**TOKENS, "Host": "127.0.0.1"},
        {**TOKENS, "Origin": "http://evil.example"},
        {**TOKENS, "Origin": "null"},
        {**TOKENS, "Origin": ADDRESS.replace("http:", "https:")},
    ],
    ids=repr,
)
def test_other_pages_get_nothing(headers: dict[str, str], tmp_path: Path) -> None:
    page = page_on(tmp_path)
    sent = {name.encode(): value.encode("latin-1") for name, value in headers.items()}
    assert page.client.get("/api/file", headers=sent).status_code == 403
    assert page.client.post("/api/save", json={"text": "", "based_on": None}, headers=sent).status_code == 403
    assert page.path.read_text(encoding="utf-8") == "WHEN DoorbellRings THEN OpenDoor\n"


@pytest.mark.parametrize("query", ["", "?token=", "?token=x", f"?token={TOKEN}&token=x", "?token=%ff"])
def test_the_page_needs_the_token(query: str, tmp_path: Path) -> None:
    answer = page_on(tmp_path).client.get(f"/{query}")
    assert answer.status_code == 403
    assert "open the address that the command printed last" in answer.text
    assert answer.headers["content-type"].startswith("text/html")


def test_the_page_is_shown_with_the_token(tmp_path: Path) -> None:
    answer = page_on(tmp_path).client.get(f"/?token={TOKEN}")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/html")


@pytest.mark.parametrize("host", ["localhost:8123", "127.0.0.1:8123"])
def test_both_names_of_this_machine_are_allowed(host: str, tmp_path: Path) -> None:
    headers = {**TOKENS, "Host": host, "Origin": f"http://{host}"}
    assert page_on(tmp_path).client.get("/api/disk", headers=headers).status_code == 200


@pytest.mark.parametrize("path", ["/", f"/?token={TOKEN}", "/api/file", "/assets/missing.js", "/missing"])
def test_every_response_has_the_headers_that_keep_scripts_out(path: str, tmp_path: Path) -> None:
    headers = page_on(tmp_path).client.get(path, headers=TOKENS).headers
    policy = headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "script-src 'self'" in policy
    assert "unsafe" not in policy
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["cache-control"] == "no-store"
    assert headers["referrer-policy"] == "no-referrer"
    assert "access-control-allow-origin" not in headers


@pytest.mark.parametrize(
    "path", ["/assets/", "/assets", "/assets/..%2findex.html", "/assets/%2e%2e/index.html", "/api/"]
)
def test_no_folder_is_listed_or_left(path: str, tmp_path: Path) -> None:
    answer = page_on(tmp_path).client.get(path, headers=TOKENS, follow_redirects=False)
    assert answer.status_code in (403, 404)


def test_a_link_among_the_files_of_the_page_leads_nowhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "built" / "assets").mkdir(parents=True)
    (tmp_path / "secret.txt").write_text("secret", encoding="utf-8")
    os.symlink(tmp_path / "secret.txt", tmp_path / "built" / "assets" / "secret.txt")
    monkeypatch.setattr("sleec_verify.serve.application.PAGE", tmp_path / "built")
    assert page_on(tmp_path).client.get("/assets/secret.txt").status_code == 404


def test_a_huge_request_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(access, "LARGEST_BODY", 2**20)
    page = page_on(tmp_path)
    assert "larger than 1 MiB" in page.post("check", 413, text="x" * 2**20)["message"]
    page.post("draft", text="x" * 2**19, based_on=None)
