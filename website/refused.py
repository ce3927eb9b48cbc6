"""Examples of rejected rules in the docs, with their errors."""

from __future__ import annotations

import re

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_verify.report.full import error_lines
from sleec_verify.report.palette import PLAIN

BLOCK = re.compile(r"^```(?:sleec|dsl)-bad\n(.*?)^```\n", re.MULTILINE | re.DOTALL)


def with_answers(markdown: str) -> str:
    """The page with each such text followed by its errors, as `sleec-verify check -` prints them.

    Raises:
        ValueError: one of the texts is accepted.
    """

    def with_answer(block: re.Match[str]) -> str:
        return f"{block.group()}\n```{{ .text .refusal }}\n{_answer(block.group(1))}\n```\n"

    return BLOCK.sub(with_answer, markdown)


def _answer(text: str) -> str:
    try:
        parse(text, "rules.sleec")
    except LanguageError as error:
        return "\n".join(error_lines(error, PLAIN)).strip()
    raise ValueError(f"this is shown as refused, and it is accepted:\n{text}")
