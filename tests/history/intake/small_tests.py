"""Folders of small tests to import: a loaded bar at two levels, a reading every 15 degrees."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

TEXT = """\
schema = "elastogeo.test/1"
name = "{name}"
machine = "{machine}"
instrument = "loaded-ball-bar"

[about]
{about}

[setup]
feed_mm_min = {feed}
{setup}

[setup.circle]
radius_mm = {radius}
plane = "XY"

[question]
parameters = ["C_XXX", "C_YYY", "E_Xt0", "E_Yt0"]

"""


def about(date: str = "2026-03-01", **more: str) -> str:
    """The table `about`, a line an entry; an empty date is left out."""
    entries = {"date": date, **more}
    return "\n".join(f'{key} = "{value}"' for key, value in entries.items() if value)


def write_test(
    folder: Path,
    *,
    name: str = "Monthly",
    date: str = "2026-03-01",
    forces: Sequence[float] = (36.0, 742.0),
    feed: float = 2000,
    radius: float = 150,
    machine: str = "hermle_c50",
    setup: str = "",
    seed: int = 0,
    softer: float = 0.0,
    **more: str,
) -> Path:
    """A folder with a test, of which every seed gives other readings; `softer` adds to what the bar pushes [um/N]."""
    random = np.random.default_rng(seed)
    text = TEXT.format(name=name, machine=machine, about=about(date, **more), feed=feed, setup=setup, radius=radius)
    (folder / "runs").mkdir(parents=True)
    angle = np.arange(0.0, 360.0, 15.0)
    for force in forces:
        give = force * (0.06 + softer) * np.cos(np.radians(angle)) ** 2 + force * 0.05 * np.sin(np.radians(angle)) ** 2
        radial = 2.0 * np.cos(np.radians(angle)) + give + random.normal(0, 0.07, len(angle))
        rows = "".join(f"{a:g},{r:.6f}\n" for a, r in zip(angle, radial, strict=True))
        (folder / "runs" / f"{force:g}N.csv").write_text(f"angle_deg,radial_um\n{rows}", encoding="utf-8")
        text += f'[[runs]]\nfile = "runs/{force:g}N.csv"\nforce_N = {force:g}\n\n'
    (folder / "test.toml").write_text(text, encoding="utf-8")
    return folder
