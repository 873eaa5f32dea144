"""How long a redraw of the sliders of a test's page takes: in headless Chromium, as a person drags.

    python -m benchmarks.what_if [STORE TEST]

Without a store it makes one with the reconstructed test of the examples. Nothing is asserted.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from playwright.sync_api import sync_playwright

import elastogeo as eg
from tests.web.browsing import chromium_or_skip, serving

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "hermle-c50-reconstructed"
MOVES = 300
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
            for width, height in ((1400, 900), (390, 844)):
                page = chromium.new_page(viewport={"width": width, "height": height})
                page.goto(f"{site.url}/tests/{key}")
                page.locator("#deviations").wait_for()
                runs = page.evaluate("document.querySelectorAll('.what-if').length")
                causes = page.evaluate("document.querySelectorAll('.cause').length")
                times = np.array(page.evaluate(DRAG, MOVES))
                middle, high, most = np.percentile(times, (50, 95, 100))
                print(
                    f"{width} x {height}, {causes} causes, {runs} runs: {len(times)} redraws, "
                    f"median {middle:.1f} ms, p95 {high:.1f} ms, longest {most:.1f} ms (a frame has 16 ms)"
                )
                page.close()
            chromium.close()


def _made(folder: Path) -> tuple[str, int]:
    with eg.History(folder / "bench.db", create=True, who="bench") as history:
        history.add_machine("Hermle C50")
        added = history.add(EXAMPLE, machine="Hermle C50")
        assert added.imported is not None
        history.draw(added.imported.test)
        return str(folder / "bench.db"), added.imported.test


if __name__ == "__main__":
    main()
