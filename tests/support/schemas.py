"""The published schemas of our JSON."""

from __future__ import annotations

import json
from typing import Any

from jsonschema import Draft202012Validator
from referencing import Registry, Resource

from tests.support.paths import ROOT

FOLDER = ROOT / "docs" / "schema"
SCHEMAS: dict[str, Any] = {
    path.name.removesuffix(".schema.json"): json.loads(path.read_text(encoding="utf-8"))
    for path in sorted(FOLDER.glob("*.schema.json"))
}
_REGISTRY: Registry[Any] = [Resource.from_contents(schema) for schema in SCHEMAS.values()] @ Registry()


def validator(name: str) -> Draft202012Validator:
    """For what a command prints. A schema refers to another one by its `$id`."""
    return Draft202012Validator(SCHEMAS[name], registry=_REGISTRY)
