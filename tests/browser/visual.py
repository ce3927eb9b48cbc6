"""Pictures of a page that are the same on every machine, and their comparison with committed ones."""

from __future__ import annotations

import os
import re
from base64 import b64encode
from pathlib import Path
from typing import NamedTuple

from playwright.sync_api import Page

from tests.browser.box_font import faces
from tests.browser.conftest import SCREENSHOTS

REFERENCES = Path(__file__).with_name("references")

CELL, TOLERANCE, MOST_CELLS = 8, 12, 4
"""Two pictures differ if the mean colour differs by more than TOLERANCE of 255 in more than MOST_CELLS cells of CELL
times CELL pixels. So another version of Chromium may draw the pixels at the edges of shapes in another way."""

_FONTS = {"box-serif": 500, "box-sans": 540, "box-mono": 600}
_FAMILIES = {
    r"\bGeorgia\b": "box-serif",
    r"\bsystem-ui\b|(?<=px )sans-serif\b": "box-sans",
    r"\bui-monospace\b": "box-mono",
}

_COMPARE = """async ([cell, tolerance, ...urls]) => {
  const pixels = async (url) => {
    const image = await createImageBitmap(await (await fetch(url)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d", { willReadFrequently: true });
    canvas.drawImage(image, 0, 0);
    return canvas.getImageData(0, 0, image.width, image.height);
  };
  const [one, other] = await Promise.all(urls.map(pixels));
  if (one.width !== other.width || one.height !== other.height)
    return [`the page is ${one.width}x${one.height}, and it was ${other.width}x${other.height}`];
  const found = [];
  for (let top = 0; top < one.height; top += cell)
    for (let left = 0; left < one.width; left += cell) {
      const sums = [0, 0, 0];
      const bottom = Math.min(top + cell, one.height), right = Math.min(left + cell, one.width);
      for (let y = top; y < bottom; y++)
        for (let x = left; x < right; x++)
          for (let part = 0; part < 3; part++) {
            const at = 4 * (y * one.width + x) + part;
            sums[part] += one.data[at] - other.data[at];
          }
      const number = (bottom - top) * (right - left);
      if (sums.some((sum) => Math.abs(sum) > tolerance * number)) found.push(`cell at ${left}, ${top}`);
    }
  return found;
}"""


class Medium(NamedTuple):
    """Where a page is shown."""

    width: int
    print: bool = False


MEDIA = {"wide": Medium(900), "narrow": Medium(360), "print": Medium(760, print=True)}


def with_box_fonts(html: str) -> str:
    """The page with a box for each character, in one font for each family of its style sheet."""
    before, style, after = re.split(r"(?<=<style>)(.*?)(?=</style>)", html, maxsplit=1, flags=re.DOTALL)
    for family, box in _FAMILIES.items():
        style, count = re.subn(family, box, style)
        assert count, f"the style sheet names {family}"
    return before + "".join(faces(*one) for one in _FONTS.items()) + style + after


def picture(page: Page, medium: Medium) -> bytes:
    """The whole page as a PNG."""
    page.emulate_media(media="print" if medium.print else "screen")
    page.set_viewport_size({"width": medium.width, "height": 800})
    shown: bytes = page.screenshot(full_page=True, animations="disabled")
    return shown


def differences(page: Page, one: bytes, other: bytes) -> list[str]:
    """Where two pictures differ, as `page` sees them; empty if they show the same."""
    if one == other:
        return []
    urls = [f"data:image/png;base64,{b64encode(data).decode()}" for data in (one, other)]
    found: list[str] = page.evaluate(_COMPARE, [CELL, TOLERANCE, *urls])
    return found if len(found) > MOST_CELLS or "page" in "".join(found) else []


def compare_with_reference(page: Page, name: str, medium: Medium) -> None:
    """Fail if the page differs from the committed picture. UPDATE_DOCUMENTS=1 replaces that picture."""
    now, reference = picture(page, medium), REFERENCES / f"{name}.png"
    SCREENSHOTS.mkdir(exist_ok=True)
    (SCREENSHOTS / f"{name}.png").write_bytes(now)
    if os.environ.get("UPDATE_DOCUMENTS"):
        REFERENCES.mkdir(exist_ok=True)
        reference.write_bytes(now)
    found = differences(page, now, reference.read_bytes())
    assert not found, f"compare .browser/{name}.png with {reference}: {len(found)} differences, first {found[0]}"
