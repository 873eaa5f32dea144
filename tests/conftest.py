"""What all tests share: deterministic examples, and builders of machines and of ball-bar tests."""

from __future__ import annotations

import inspect
import os
import re
import sys
import textwrap
from types import ModuleType

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: workers on shared cores wait for each other's threads

from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Question, Run

settings.register_profile("house", derandomize=True, database=None, deadline=None, print_blob=False)
settings.load_profile("house")


def follow_recipe(register: str, name: str) -> None:
    """Make the file that the docstring of a register teaches, as it stands there, and register what it defines.

    The contract suites then run on the recipes themselves.
    """
    found = re.search(r"A complete one,\s`\w+\.py`::\n\n((?:    .*\n|\n)+)", f"{inspect.getdoc(import_module(register))}\n")
    assert found
    module = sys.modules.setdefault(name, ModuleType(name))
    exec(compile(textwrap.dedent(found[1]), f"{name}.py", "exec"), module.__dict__)


follow_recipe("elastogeo.observe.instruments", "recipe_dial_gauge")
follow_recipe("elastogeo.sources.families", "recipe_sliding_compliance")

SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
"""Data sets that stay beside the repository; a clone may be without them."""

THESIS_FORCES = (36.0, 112.0, 238.0, 364.0, 490.0, 616.0, 742.0)
"""The force levels [N] of thesis 4.6."""


def full_circle(readings: int) -> Array:
    """Evenly spaced angles [rad] over one turn, the end left out."""
    return np.arange(readings) * 2 * np.pi / readings


def build_machine(topology: str, tool: Sequence[float] = (0.0, 0.0, 0.0), seed: int | None = None) -> Machine:
    """A machine; with a seed, its links have random offsets and its axes random small inclinations."""
    parsed = parse_topology(topology)
    if seed is None:
        return Machine(topology, parsed, tool=tuple(tool))
    random = np.random.default_rng(seed)
    joints = tuple(
        Joint(
            axis,
            offset=tuple(random.uniform(-300, 300, 3)),
            tilt=tuple(random.uniform(-0.3, 0.3, 3)),
            compliant=axis != "S",
        )
        for axis in parsed.axes
    )
    return Machine(topology, parsed, joints, tool=tuple(tool))


def build_ball_bar_test(
    machine: str | Machine,
    forces: Sequence[float] = (100.0,),
    *,
    circle: Circle | None = None,
    angle: Array | None = None,
    readings: int = 36,
    parameters: Sequence[str] = ("planar-xy",),
    reference: float | None = None,
    prefer: Sequence[str] = (),
    repeats: int = 1,
    sense: int = 1,
    set_up_per_run: bool = False,
) -> MachineTest:
    """A loaded ball bar test with blank readings: one run per force and repeat; the set-up counts as right by default."""
    machine = build_machine(machine) if isinstance(machine, str) else machine
    angle = full_circle(readings) if angle is None else angle
    runs = tuple(
        Run(f"{force:g} N, {k}", {"angle": angle, "radial": np.zeros(len(angle))}, force=force, sense=sense, repeat=k)
        for force in forces
        for k in range(1, repeats + 1)
    )
    setup = LoadedBallBar(circle or Circle(150.0), feed=2000 / 60)
    question = Question(tuple(parameters), reference, tuple(prefer), set_up_per_run=set_up_per_run)
    return MachineTest("test", machine, setup, runs, question)


@pytest.fixture(scope="session")
def make_machine() -> Callable[..., Machine]:
    return build_machine


@pytest.fixture(scope="session")
def make_test() -> Callable[..., MachineTest]:
    return build_ball_bar_test


@pytest.fixture(scope="session")
def thesis_forces() -> tuple[float, ...]:
    return THESIS_FORCES


@pytest.fixture(scope="session")
def shared_data() -> Path:
    return SHARED_DATA


def pytest_unconfigure(config: pytest.Config) -> None:
    """Say in the last line of a test run what was left out of it, so that nobody takes it for tested."""
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    if reporter is None or hasattr(config, "workerinput") or config.option.collectonly:
        return
    reports = [report for report in reporter.stats.get("skipped", []) if isinstance(report.longrepr, tuple)]
    reasons = sorted({str(report.longrepr[2]).removeprefix("Skipped: ") for report in reports})
    reporter.ensure_newline()
    reporter.write_line(f"Left out: {'; '.join(reasons) or 'nothing'}.")
