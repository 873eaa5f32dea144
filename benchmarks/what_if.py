"""How long a redraw of the sliders of a test's page takes: in headless Chromium, as a person drags.

    python -m benchmarks.what_if [STORE TEST]

Without a store it makes one with the reconstructed test of the examples. A redraw is the script alone; a whole frame is
script, style, layout, paint and commit of the page's thread, while Chromium traces it, which costs some of the time. Its
clock holds whoever else uses the cores; its time of the processor does not. Nothing is asserted.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import sync_playwright

import elastogeo as eg
from tests.web.browsing import chromium_or_skip, serving

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "hermle-c50-reconstructed"
MOVES = 300
ROUNDS = 3
SCREENS = ((1400, 900), (390, 844))
DRAG = """moves => new Promise(done => {
  const sliders = [...document.querySelectorAll('.cause input')]; let i = 0;
  performance.clearMeasures('what-if');
  const move = () => {
    const one = sliders[i % sliders.length];
    one.value = (37 * i) % 200;
    one.dispatchEvent(new Event('input', { bubbles: true }));
    if (++i < moves) requestAnimationFrame(move);
    else setTimeout(() => done(performance.getEntriesByName('what-if').map(one => one.duration)), 200);
  };
  move();
})"""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        store, key = (sys.argv[1], int(sys.argv[2])) if len(sys.argv) > 2 else _made(Path(folder))
        with serving(Path(store), Path(folder) / "serve.log") as site, sync_playwright() as found:
            chromium = found.chromium.launch(executable_path=chromium_or_skip(), args=["--no-sandbox", "--disable-gpu"])
            for width, height in SCREENS * ROUNDS:
                page = chromium.new_page(viewport={"width": width, "height": height})
                page.goto(f"{site.url}/tests/{key}")
                page.locator("#deviations").wait_for()
                runs = page.evaluate("document.querySelectorAll('.what-if').length")
                causes = page.evaluate("document.querySelectorAll('.cause').length")
                redraws = page.evaluate(DRAG, MOVES)
                chromium.start_tracing(page=page, categories=["devtools.timeline", "blink", "cc"])
                page.evaluate(DRAG, MOVES)
                frames = _frames(json.loads(chromium.stop_tracing())["traceEvents"])
                print(f"{width} x {height}, {causes} causes, {runs} runs; a frame has 16 ms")
                _say("redraw, clock", redraws)
                _say("whole frame, CPU", [used for _, used in frames])
                _say("whole frame, clock", [lasted for lasted, _ in frames])
                lasted, used = max(frames)
                print(f"  of the frame that lasted {lasted:.1f} ms it used the processor for {used:.1f} ms", flush=True)
                page.close()
            chromium.close()


def _frames(events: list[dict[str, Any]]) -> list[tuple[float, float]]:
    """How long each frame lasted and used the processor [ms]: from the script to what is handed to be painted."""
    frames = [one for one in events if one["name"] == "ProxyMain::BeginMainFrame" and one.get("ph") == "X"]
    return [(one["dur"] / 1000, one["tdur"] / 1000) for one in frames]


def _say(what: str, times: list[float]) -> None:
    middle, high, most = np.percentile(times, (50, 95, 100))
    print(f"  {what:<20}{len(times):>5}: median {middle:5.1f} ms, 95 % {high:5.1f} ms, longest {most:5.1f} ms")


def _made(folder: Path) -> tuple[str, int]:
    with eg.History(folder / "bench.db", create=True, who="bench") as history:
        history.add_machine("Hermle C50")
        added = history.add(EXAMPLE, machine="Hermle C50")
        assert added.imported is not None
        history.draw(added.imported.test)
        return str(folder / "bench.db"), added.imported.test


if __name__ == "__main__":
    main()
