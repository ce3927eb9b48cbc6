"""Writes `sleec_verify/checks/unicode_confusables.py`, from Unicode's table of confusable characters.

The package `confusable_homoglyphs` keeps that table as JSON. To renew it:

    .venv/bin/python -m pip download --no-deps -d /tmp confusable_homoglyphs
    .venv/bin/python tools/confusables.py /tmp/confusable_homoglyphs-*.whl
"""

from __future__ import annotations

import json
import string
import sys
from pathlib import Path
from unicodedata import normalize
from zipfile import ZipFile

TARGET = Path(__file__).parents[1] / "sleec_verify" / "checks" / "unicode_confusables.py"
TABLE = "confusable_homoglyphs/confusables.json"
LICENSE = Path(__file__).with_name("unicode-license.txt")
HEAD = '''"""Letters and digits that look like those of ASCII. Written by `tools/confusables.py`; do not edit.

The data is from confusables.txt of Unicode Technical Standard #39, as {source} has it, under this
licence:

{license}"""

from __future__ import annotations

from collections.abc import Mapping

LOOKALIKES: Mapping[str, str] = {{
'''


def lookalikes(table: dict[str, list[dict[str, str]]]) -> dict[str, str]:
    """The letters and digits that look like each letter and digit of ASCII, without those whose compatibility
    decomposition says so already."""
    found = {}
    for plain in string.digits + string.ascii_letters:
        # Characters that are written from the right are between marks of direction there.
        alike = {entry["c"].strip("\u200e") for entry in table.get(plain, ())}
        others = [c for c in alike if len(c) == 1 and not c.isascii() and c.isalnum() and normalize("NFKD", c) == c]
        if others:
            found[plain] = "".join(sorted(others))
    return found


def written(found: dict[str, str], source: str) -> str:
    """The module, in the layout of `ruff format`."""
    rows = [HEAD.format(source=source, license=LICENSE.read_text(encoding="utf-8"))]
    for plain, others in found.items():
        codes = [ascii(c)[1:-1] for c in others]
        row = f'    "{plain}": "{"".join(codes)}",\n'
        if len(row) > 121:
            parts = ("".join(codes[at : at + 12]) for at in range(0, len(codes), 12))
            row = f'    "{plain}": (\n' + "".join(f'        "{part}"\n' for part in parts) + "    ),\n"
        rows.append(row)
    return "".join([*rows, "}\n"])


def main() -> None:
    wheel = Path(sys.argv[1])
    with ZipFile(wheel) as file:
        table = json.loads(file.read(TABLE))
    source = " ".join(wheel.name.split("-")[:2])
    TARGET.write_text(written(lookalikes(table), source), encoding="utf-8")


if __name__ == "__main__":
    main()
