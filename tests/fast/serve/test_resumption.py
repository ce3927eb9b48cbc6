"""After a restart, an open page continues. Nobody else learns the token."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from sleec_verify.serve.kept_address import KeptAddress
from sleec_verify.serve.key import Key
from tests.support.pages import KEY, PORT, TOKEN, page_on


def test_a_page_that_knows_the_secret_gets_the_next_token(tmp_path: Path) -> None:
    page = page_on(tmp_path)
    assert page.get("secret") == {"secret": KEY.secret}
    answer = page.client.get("/api/resumption?challenge=abc").json()
    known = Key(PORT, KEY.secret, answer["salt"])
    assert (answer["response"], TOKEN) == (known.response("abc"), known.token)
    assert set(answer) == {"salt", "response"}


def test_the_secret_needs_the_token(tmp_path: Path) -> None:
    assert page_on(tmp_path).client.get("/api/secret").status_code == 403


@pytest.mark.parametrize("headers", [{"Host": "evil.example"}, {"Origin": "http://evil.example"}], ids=str)
def test_other_origins_get_no_salt(headers: dict[str, str], tmp_path: Path) -> None:
    assert page_on(tmp_path).client.get("/api/resumption", headers=headers).status_code == 403


def test_tokens_and_responses_depend_on_everything() -> None:
    keys = [KEY, KEY._replace(port=1), KEY._replace(salt="b"), KEY._replace(secret="6")]
    assert len({key.token for key in keys} | {key.response(c) for key in keys for c in "xy"}) == 12


def test_the_address_is_kept_for_its_user_only(tmp_path: Path) -> None:
    folder = tmp_path / "state"
    rules = str(tmp_path / "rules.sleec")
    first = KeptAddress.read(rules, str(folder))
    assert first.port == 0
    assert len(first.secret) == 64
    first._replace(port=PORT).keep(rules, str(folder))
    assert KeptAddress.read(rules, str(folder)) == first._replace(port=PORT)
    assert KeptAddress.read(str(tmp_path / "others.sleec"), str(folder)).secret != first.secret
    (file,) = folder.iterdir()
    assert file.stat().st_mode & 0o777 == 0o600
    assert folder.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize(
    "change", [{"since": 0}, {"since": 1e12}, {"port": 0}, {"port": 70_000}, {"port": "x"}, {"secret": ""}], ids=str
)
def test_an_old_or_damaged_address_is_replaced(change: dict[str, object], tmp_path: Path) -> None:
    rules = str(tmp_path / "rules.sleec")
    kept = KeptAddress.read(rules, str(tmp_path))._replace(port=PORT)
    kept.keep(rules, str(tmp_path))
    (file,) = tmp_path.iterdir()
    file.write_text(json.dumps({**kept._asdict(), **change}), encoding="utf-8")
    found = KeptAddress.read(rules, str(tmp_path))
    assert found.port == 0
    assert found.secret != kept.secret
    file.write_text("[", encoding="utf-8")
    assert KeptAddress.read(rules, str(tmp_path)).secret != kept.secret
