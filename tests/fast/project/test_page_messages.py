"""The page has the same texts in each language, with the same placeholders."""

from __future__ import annotations

import re

from sleec_verify.wording.translation import LANGUAGES
from tests.support.paths import ROOT

FOLDER = ROOT / "frontend" / "src" / "messages"


def texts(language: str) -> dict[str, str]:
    return dict(
        re.findall(r'^  (\w+): "(.+)",$', (FOLDER / f"{language}.ts").read_text(encoding="utf-8"), re.MULTILINE)
    )


def test_every_language_has_the_same_texts_and_placeholders() -> None:
    placeholders = {
        language: {name: sorted(re.findall(r"\{\w+\}", text)) for name, text in texts(language).items()}
        for language in LANGUAGES
    }
    assert len(placeholders["en"]) > 100
    assert placeholders["it"] == placeholders["en"] == placeholders["de"]


def test_each_line_is_one_text_that_the_page_uses() -> None:
    source = "".join(
        path.read_text(encoding="utf-8") for path in (ROOT / "frontend" / "src").rglob("*.ts*") if path.parent != FOLDER
    )
    for language in LANGUAGES:
        lines = (FOLDER / f"{language}.ts").read_text(encoding="utf-8").split(" = {\n")[1].split("};")[0]
        assert len(lines.splitlines()) == len(texts(language))
    assert [name for name in texts("en") if f'"{name}"' not in source] == []
