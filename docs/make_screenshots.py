"""Make the pictures of the pages in `docs/web`: every page in light, dark, on a phone and printed.

`python docs/make_screenshots.py [URL]`: of the server at the URL, by default of the small fleet of the tests, which it
serves itself. All that the pictures show is simulated. It needs Chromium and the extras `dev`.
"""

from __future__ import annotations

import io
import re
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Browser, sync_playwright

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.web.addresses import addresses  # noqa: E402
from tests.web.browsing import chromium_or_skip, serving  # noqa: E402
from tests.web.fleets import DATABASE, make_fleet  # noqa: E402

FOLDER = Path(__file__).with_name("web")
COLOURS = 64
"""Of a picture: pages are flat."""
TALLEST = 1500
"""Pixels that a picture shows of a long page."""
DESKTOP, PHONE, PAPER = (1400, 900), (390, 844), (794, 1123)
LOOKS: dict[str, dict[str, Any]] = {
    "light": {"size": DESKTOP},
    "dark": {"size": DESKTOP, "color_scheme": "dark"},
    "phone": {"size": PHONE},
    "print": {"size": PAPER, "media": "print"},
}


def name_of(path: str) -> str:
    """`/machines/1?span=all` is `machines-1`."""
    return re.sub(r"\W+", "-", path.partition("?")[0]).strip("-") or "fleet"


def small(picture: bytes) -> Image.Image:
    """Few colours, not taller than one looks at."""
    found = Image.open(io.BytesIO(picture)).convert("RGB")
    found = found.crop((0, 0, found.width, min(found.height, TALLEST)))
    return found.quantize(COLOURS, dither=Image.Dither.NONE)


def make(browser: Browser, url: str, paths: list[str], folder: Path) -> int:
    """Every page in every look; the size of all [B]."""
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    for look, how in LOOKS.items():
        width, height = how["size"]
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme=how.get("color_scheme", "light"),
            reduced_motion="reduce",
            locale="en-GB",
        )
        page = context.new_page()
        for path in paths:
            answer = page.goto(url + path)
            if answer is None or answer.status != 200:
                raise SystemExit(f"{path} answered {answer and answer.status}; no pictures of errors")
            page.locator("[hx-trigger*='every 1s']").wait_for(state="detached", timeout=120_000)
            time.sleep(0.3)  # until what scripts draw is there
            page.emulate_media(media=how.get("media", "screen"))
            small(page.screenshot(full_page=True)).save(folder / f"{name_of(path)}-{look}.png", optimize=True)
        context.close()
    return sum(file.stat().st_size for file in folder.glob("*.png"))


def main() -> None:
    """Make them all, and say how large they are."""
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as place:
        browser = playwright.chromium.launch(executable_path=chromium_or_skip(), args=["--no-sandbox", "--no-proxy-server"])
        if len(sys.argv) > 1:
            size = make(browser, sys.argv[1].rstrip("/"), addresses(), FOLDER)
        else:
            make_fleet(Path(place) / "fleet")
            with serving(Path(place) / "fleet" / DATABASE, Path(place) / "serve.log") as site:
                size = make(browser, site.url, addresses(), FOLDER)
        browser.close()
    print(f"{len(list(FOLDER.glob('*.png')))} pictures in {FOLDER.relative_to(ROOT)}, {size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
