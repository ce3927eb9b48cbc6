"""A text of 2,000 rules stays usable."""

from __future__ import annotations

from pathlib import Path

from benchmarks.random_rules import random_rules
from tests.support.pages import page_on


def test_two_thousand_rules(tmp_path: Path) -> None:
    text = random_rules(2_000, hedges=1)
    page = page_on(tmp_path, text)
    first = page.post("check", text=text)
    assert len(first["rules"]) == 2_000
    changed = page.post("check", text=text.replace("RULE r50\n", "RULE renamed\n"))
    assert changed["rules"][50]["label"] == "renamed"
    assert changed["seconds"] < first["seconds"]
    trigger = changed["rules"][50]["trigger"]
    assert page.post("situation", text=text, triggers=[trigger])["rules"]
