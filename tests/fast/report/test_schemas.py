"""The published schemas themselves."""

from __future__ import annotations

import pytest
from jsonschema import Draft202012Validator

from tests.support.pyprojects import VERIFY
from tests.support.schemas import SCHEMAS


@pytest.mark.parametrize("name", SCHEMAS)
def test_a_schema_is_valid_and_says_where_it_is(name: str) -> None:
    Draft202012Validator.check_schema(SCHEMAS[name])
    source = VERIFY["project"]["urls"]["Source"]
    assert SCHEMAS[name]["$id"] == f"{source}/raw/main/docs/schema/{name}.schema.json"
