"""The files that say how to work with the project: security, contributing, citing, issues."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.support.paths import ROOT
from tests.support.pyprojects import VERIFY

TEMPLATES = ROOT / ".github" / "ISSUE_TEMPLATE"
SOURCE = VERIFY["project"]["urls"]["Source"]


def read(path: Path) -> dict[str, Any]:
    content: dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))
    return content


@pytest.mark.parametrize(
    "path", [path for path in sorted(TEMPLATES.glob("*.yml")) if path.name != "config.yml"], ids=lambda path: path.stem
)
def test_an_issue_form_is_one(path: Path) -> None:
    form = read(path)
    assert {"name", "description", "body"} <= form.keys() <= {"name", "description", "title", "labels", "body"}
    ids = [field["id"] for field in form["body"]]
    assert len(ids) == len(set(ids))
    for field in form["body"]:
        assert field["type"] in ("input", "textarea")
        assert field["attributes"]["label"]
    assert any(field.get("validations") == {"required": True} for field in form["body"])


def test_vulnerabilities_are_not_reported_in_issues() -> None:
    config = read(TEMPLATES / "config.yml")
    assert config["blank_issues_enabled"] is False
    assert [link["url"] for link in config["contact_links"]] == [f"{SOURCE}/security/policy"]
    assert f"{SOURCE}/security/advisories/new" in (ROOT / "SECURITY.md").read_text(encoding="utf-8")


def test_the_citation_names_this_project_and_the_paper() -> None:
    """`cffconvert --validate` checks the format; these are the keys that version 1.2.0 requires."""
    citation = read(ROOT / "CITATION.cff")
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= citation.keys()
    assert citation["authors"] == VERIFY["project"]["authors"]
    assert citation["license"] == VERIFY["project"]["license"]
    assert citation["repository-code"] == SOURCE
    (paper,) = citation["references"]
    assert {"type", "title", "authors"} <= paper.keys()
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    assert f"*{paper['title']}*" in readme
    for author in paper["authors"]:
        assert author.keys() == {"given-names", "family-names"}
        assert author["family-names"] in readme
