"""Inputs that contradict themselves are refused with one clear error; what ordinary tests do passes."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import example_test, read_test
from elastogeo.machine import Array
from elastogeo.observe import Run, check_runs, turning

TURN = np.arange(720) * 0.5
"""Degrees of one turn."""


def trace(
    degrees: Array = TURN, force: float = 0.0, scale: float = 1.0, seed: int = 0, noise: float = 1e-4, step: float = 0.0
) -> dict[str, Array]:
    """A radial trace [mm]: 5 um of geometry, 40 nm/N of compliance, white noise; quantised if a step is given."""
    angle = np.deg2rad(degrees)
    radial = 5e-3 * np.cos(2 * angle) + 4e-5 * force * np.cos(angle) ** 2
    radial = radial + noise * np.random.default_rng(seed).standard_normal(len(angle))
    radial = np.round(radial / step) * step if step else radial
    return {"angle": angle, "radial": scale * radial}


def run(name: str, columns: dict[str, Array], force: float = 0.0, sense: int = 1, sha256: str = "") -> Run:
    return Run(name, columns, force=force, sense=sense, file=f"runs/{name}.csv", sha256=sha256)


@pytest.mark.parametrize(
    ("degrees", "way"),
    [
        (TURN, 1),
        (TURN[::-1], -1),
        (np.remainder(TURN + 200, 360), 1),
        (np.remainder(200 - TURN, 360), -1),
        (np.linspace(-20, 200, 111), 1),
        (np.linspace(0, -720, 400), -1),
        (TURN + 0.6 * np.random.default_rng(1).standard_normal(720), 0),
        (TURN + 0.02 * np.random.default_rng(1).standard_normal(720), 1),
        (np.array([0.0, 90.0, 180.0, 270.0]), 0),
        (np.array([0.0]), 0),
        (np.zeros(5), 0),
        (np.concatenate([TURN, TURN[::-1]]), 0),
    ],
)
def test_the_direction_of_a_run_shows_in_its_angles_or_is_left_open(degrees: Array, way: int) -> None:
    assert turning(np.deg2rad(degrees)) == way


def test_a_counter_clockwise_run_whose_angles_fall_is_refused() -> None:
    with pytest.raises(InputError, match="run 'a' goes clockwise, its angles fall, but the test says sense = \"ccw\""):
        check_runs([run("a", trace(TURN[::-1]))])


def test_a_clockwise_run_whose_angles_grow_is_refused_where_those_of_others_fall() -> None:
    falling = run("b", trace(TURN[::-1], seed=1), sense=-1)
    growing = run("a", trace(), sense=-1)
    with pytest.raises(InputError, match="run 'a' goes counter-clockwise, its angles grow while those of other clockwise"):
        check_runs([falling, growing])
    check_runs([growing, run("c", trace(seed=2))])  # both sorted by angle, as some software writes them


def test_one_run_in_radians_is_refused() -> None:
    runs = [run("a", trace()), run("b", trace(TURN * np.pi / 180, seed=1)), run("c", trace(seed=2))]
    with pytest.raises(InputError, match=r"run 'b' spans 6\.274 degrees, the other runs 359\.5; its angles are radians"):
        check_runs(runs)
    with pytest.raises(InputError, match=r"run 'b' spans 6\.274 degrees, a full turn in radians; its angles are radians"):
        check_runs(runs[1:2])
    arc = np.linspace(-30, 200, 300)
    with pytest.raises(InputError, match=r"run 'b' spans 4\.014 degrees, the other runs 230"):
        check_runs([run("a", trace(arc)), run("b", trace(arc * np.pi / 180, seed=1))])


@pytest.mark.parametrize("others", [1, 2, 6])
@pytest.mark.parametrize("decimals", [6, 3])
def test_one_run_in_mm_under_radial_um_is_refused(others: int, decimals: int) -> None:
    """As the file says them: mm to so many decimals, taken for um."""
    small = trace(seed=9)
    small["radial"] = np.round(small["radial"], decimals) / 1000
    runs = [run(f"n{k}", trace(seed=k)) for k in range(others)]
    with pytest.raises(InputError, match=r"run 'small' has readings about 1000 times smaller.*name the column radial_mm"):
        check_runs([*runs, run("small", small)])


def test_one_run_in_mm_is_refused_at_any_level_of_force() -> None:
    forces = (36.0, 238.0, 490.0, 742.0)
    for wrong in forces:
        runs = [
            run(f"{f:g}N-{k}", trace(force=f, seed=k, scale=1e-3 if (f, k) == (wrong, 1) else 1.0), force=f)
            for f in forces
            for k in (1, 2)
        ]
        with pytest.raises(InputError, match=f"run '{wrong:g}N-1' has readings about 1000 times smaller"):
            check_runs(runs)


def test_one_run_in_um_under_radial_mm_is_refused() -> None:
    runs = [run("a", trace()), run("b", trace(seed=1)), run("large", trace(seed=2, scale=1000.0))]
    with pytest.raises(InputError, match=r"run 'large' has readings about 1000 times larger.*name the column radial_um"):
        check_runs(runs)


@pytest.mark.parametrize("force", [0.0, 364.0])
@pytest.mark.parametrize(
    ("factor", "told"),
    [
        (1 / 25.4, r"about 25\.4 times smaller.*name the column radial_in"),
        (1 / 25.4e3, r"about 25400 times smaller.*name the column radial_in"),
        (1e-6, r"about 1000000 times smaller.*name the column radial_m$"),
        (25.4, r"about 25\.4 times larger.*name the column radial_mm"),
    ],
)
def test_one_run_in_inches_or_metres_is_refused(factor: float, told: str, force: float) -> None:
    others = [run(f"n{k}", trace(force=force, seed=k), force=force) for k in range(3)]
    with pytest.raises(InputError, match=f"run 'off' has readings {told}"):
        check_runs([*others, run("off", trace(force=force, seed=9, scale=factor), force=force)])


@pytest.mark.parametrize("shown", ["time", "past a full turn"])
def test_a_rising_run_marked_clockwise_is_refused_where_it_shows_its_order(shown: str) -> None:
    """A table that is sorted by angle has no time that grows with it, and does not go past a full turn."""
    columns = trace() if shown == "time" else trace(np.remainder(TURN + 90, 360))
    if shown == "time":
        columns["time"] = np.arange(len(TURN)) * 0.01
    with pytest.raises(InputError, match=r"run 'a' goes counter-clockwise, its angles grow in the order in which they were"):
        check_runs([run("a", columns, sense=-1)])
    check_runs([run("a", trace(), sense=-1)])


def test_equal_files_are_refused_by_both_names() -> None:
    same = trace()
    with pytest.raises(InputError, match=r"runs 'a' and 'b' hold the same readings: runs/b\.csv has the content of runs/a"):
        check_runs([run("a", same, sha256="1f"), run("b", dict(same), sense=-1, sha256="1f")])


ORDINARY: dict[str, Callable[[], list[Run]]] = {
    "arcs of different length": lambda: [
        run("90", trace(np.linspace(0, 90, 200))),
        run("180", trace(np.linspace(0, 180, 400), seed=1)),
        run("360", trace(seed=2)),
        run("5", trace(np.linspace(40, 45, 50), seed=3)),
    ],
    "a small machine beside nothing": lambda: [run("a", trace(scale=1e-2))],
    "forces from 1 to 742 N without noise": lambda: [
        run(f"{f:g}", trace(force=f, noise=0.0), force=f) for f in (0.0, 1.0, 36.0, 742.0)
    ],
    "an unloaded run without any deviation": lambda: [
        run("0", {"angle": np.deg2rad(TURN), "radial": np.zeros(720)}),
        run("0 again", {"angle": np.deg2rad(TURN), "radial": np.zeros(720)}),
        run("742", trace(force=742.0), force=742.0),
    ],
    "a very quiet run beside a rough one": lambda: [
        run("rough", trace(noise=5e-3)),
        run("quiet", trace(seed=1, noise=2e-6, scale=0.05)),
    ],
    "coarse readings that repeat": lambda: [
        run("a", trace(noise=0.0, step=1e-3), sha256="1f"),
        run("b", trace(noise=0.0, step=1e-3), sha256="1f"),
    ],
    "two parts of one file": lambda: [
        run("a", trace(), sha256="1f"),
        run("b", trace(TURN[::-1], seed=1), sense=-1, sha256="1f"),
    ],
    "both directions of one table": lambda: [run("ccw", trace()), run("cw", trace(seed=1), sense=-1)],
    "few readings": lambda: [
        run("a", trace(np.array([0.0, 120.0, 240.0]))),
        run("b", trace(np.array([240.0, 120.0, 0.0]), scale=1e-3)),
    ],
}


@pytest.mark.parametrize("ordinary", ORDINARY)
def test_ordinary_runs_pass(ordinary: str) -> None:
    check_runs(ORDINARY[ordinary]())


def test_noise_of_any_kind_refuses_no_ordinary_test() -> None:
    """Geometry from 0.1 to 50 um, noise from 0.01 to 2 um, forces of the thesis: a thousand tests, none refused."""
    random = np.random.default_rng(8)
    for trial in range(250):
        size, noise = 10 ** random.uniform(-4, -1.3), 10 ** random.uniform(-5, -2.7)
        step = random.choice([0.0, 1e-4, 1e-3])
        runs = []
        for force in (36.0, 238.0, 742.0):
            columns = trace(TURN[::6], force, 1.0, int(random.integers(1 << 30)), noise, step)
            extra = size * random.uniform(0.2, 5) * np.cos(columns["angle"] + random.uniform(0, 6))
            runs.append(run(f"{trial}-{force:g}", {**columns, "radial": columns["radial"] + extra}, force))
        check_runs(runs)


def test_a_test_with_a_copied_file_is_refused_when_it_is_read(tmp_path: Path) -> None:
    folder = tmp_path / "t"
    shutil.copytree(example_test().parent / "ball-bar-diagnosis", folder)
    shutil.copy(folder / "runs" / "ccw-1.csv", folder / "runs" / "cw-1.csv")
    with pytest.raises(InputError, match=r"test\.toml: runs 'ccw-1' and 'cw-1' hold the same readings"):
        read_test(folder)


def test_the_direction_is_taken_from_the_angles_where_the_test_is_silent(tmp_path: Path) -> None:
    (tmp_path / "runs").mkdir()
    for name, degrees in (("up", TURN), ("down", TURN[::-1])):
        lines = (f"{a},{r}" for a, r in zip(degrees, 1000 * trace(degrees, seed=len(name))["radial"], strict=True))
        (tmp_path / "runs" / f"{name}.csv").write_text("angle_deg,radial_um\n" + "\n".join(lines) + "\n")
    head = (
        'schema = "elastogeo.test/1"\nname = "n"\nmachine = "hermle_c50"\ninstrument = "loaded-ball-bar"\n'
        '[about]\noperator = "A. Fischer"\ndate = 2026-03-01\nmachine_serial = "C50-1107"\n'
        "[setup]\nfeed_mm_min = 1000\n[setup.circle]\nradius_mm = 150\n"
    )
    entries = "".join(f'[[runs]]\nfile = "runs/{name}.csv"\nforce_N = 0\n' for name in ("up", "down"))
    (tmp_path / "test.toml").write_text(head + entries)
    test = read_test(tmp_path)
    assert [r.sense for r in test.runs] == [1, -1]
    assert (test.about.operator, test.about.date, test.about.machine_serial) == ("A. Fischer", "2026-03-01", "C50-1107")
    assert test.about.instrument_serial == ""
    (tmp_path / "test.toml").write_text(head.replace("operator", "operater") + entries)
    with pytest.raises(FormatError, match=r"about\.operater is not known; did you mean operator"):
        read_test(tmp_path)
