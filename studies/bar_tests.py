"""From a layout, a truth and a noise to a test as `elastogeo` takes it: the one file that touches `elastogeo`'s classes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Question, Run
from studies.ball_bar import Circles
from studies.chain import Array, Chain
from studies.noise import NOISES, Noise
from studies.truth import BALL_BAR, Truth

QUESTION = ("elasto-geometric-xy",)


@dataclass(frozen=True)
class Layout:
    """Which runs a test has: stated forces [N] and senses."""

    forces: tuple[float, ...]
    senses: tuple[int, ...] = ()

    def circles(self, chain: Chain, readings: int = 72, plane: str = "XY") -> Circles:
        """The same runs on a machine."""
        return Circles(chain, self.forces, self.senses or (1,) * len(self.forces), readings, plane=plane)


SET_ANEW = "force set anew"
"""White noise, and a force that each run sets again to 0.2 %, of a gauge that is off by 1 % in all: of loaded layouts."""

FORCE_SCATTER, FORCE_SCALE = 0.002, 0.01

LAYOUTS: dict[str, Layout] = {
    "7 runs": Layout((36.0, 112.0, 238.0, 364.0, 490.0, 616.0, 742.0)),
    "15 runs": Layout((36.0, 112.0, 238.0, *(364.0,) * 5, *(490.0,) * 5, 616.0, 742.0)),
    "8 runs": Layout((36.0, 238.0, 490.0, 742.0) * 2),
    "two runs": Layout((36.0, 742.0)),
    "one run": Layout((364.0,)),
    "three pairs": Layout((0.0,) * 6, (1, -1) * 3),
}
"""The levels of the thesis once; its 15 runs; the four levels of `elastogeo new`, twice; the two that are the least; one;
three pairs of an unloaded bar."""

LOADED = ("7 runs", "15 runs")
"""Those that print intervals."""


def make_test(
    layout: str | Layout,
    truth: Truth | None = None,
    noise: str | Noise = "white",
    seed: int | tuple[int, ...] = 0,
    *,
    topology: str = "wFYXt",
    question: tuple[str, ...] | Question | None = None,
    readings: int = 72,
    plane: str = "XY",
    resolution: float | None = None,
) -> MachineTest:
    """A test that was never measured, of a machine whose truth is known.

    Parameters
    ----------
    layout : str or Layout
        A name of `LAYOUTS`.
    truth : Truth, optional
        Tables 5.5 and 5.6; for an unloaded bar, `BALL_BAR`.
    noise : str or Noise
        A name of `NOISES`, or `SET_ANEW`.
    seed : int or tuple of int
    topology : str
        Of a machine without offsets; `machine_test` takes any chain.
    question : tuple of str, or Question
        Parameters to ask for; by default the 13 of Table 5.1, without load the faults of a ball bar.
    readings : int
        A turn.
    plane : str
    resolution : float or None [mm]
        As stated with the readings.
    """
    layout = LAYOUTS[layout] if isinstance(layout, str) else layout
    if not any(layout.forces):
        question, truth = question or ("ball-bar-xy",), truth or Truth(BALL_BAR)
    truth = truth or Truth()
    if noise == SET_ANEW:
        truth, noise = set_anew(truth, layout, seed), "white"
    circles = layout.circles(Chain(topology), readings, plane)
    return machine_test(circles, truth, noise, seed, question or QUESTION, resolution)


def set_anew(truth: Truth, layout: Layout, seed: int | tuple[int, ...]) -> Truth:
    """The same truth with the forces of one draw."""
    random = np.random.default_rng((*(seed if isinstance(seed, tuple) else (seed,)), 1))
    of_runs = tuple(map(float, FORCE_SCATTER * random.standard_normal(len(layout.forces))))
    return replace(truth, force_scale=FORCE_SCALE * float(random.standard_normal()), force_scatter=of_runs)


def machine_test(
    circles: Circles,
    truth: Truth,
    noise: str | Noise,
    seed: int | tuple[int, ...],
    question: tuple[str, ...] | Question = QUESTION,
    resolution: float | None = None,
) -> MachineTest:
    """A test of these circles with one draw of the noise."""
    random = np.random.default_rng(seed)
    noise = NOISES[noise] if isinstance(noise, str) else noise
    reading = noise.on(_true_readings(circles, truth), circles.angle, random)
    share, size = truth.outliers
    if share:
        off = random.random(reading.shape) < share
        reading = reading + size * off * random.choice((-1.0, 1.0), reading.shape)
    blank = _blank(circles)
    runs = tuple(
        replace(run, columns={"angle": angle, "radial": radial})
        for run, angle, radial in zip(blank.runs, circles.angle, reading, strict=True)
    )
    asked = question if isinstance(question, Question) else Question(question)
    return replace(blank, runs=runs, question=asked, resolution=resolution)


@lru_cache(maxsize=64)
def _true_readings(circles: Circles, truth: Truth) -> Array:
    return circles.true_readings(truth)


@lru_cache(maxsize=64)
def _blank(circles: Circles) -> MachineTest:
    chain, topology = circles.chain, parse_topology(circles.chain.topology)
    offsets = dict(chain.offsets)
    joints = tuple(Joint(axis, offset=offsets.get(axis, (0.0, 0.0, 0.0)), compliant=axis != "S") for axis in topology.axes)
    machine = Machine(chain.topology, topology, joints, tool=chain.tool)
    setup = LoadedBallBar(Circle(circles.radius, circles.plane, dict(circles.held)), feed=circles.feed)
    runs = tuple(
        Run(f"run {k + 1}", {}, force, sense=sense, repeat=circles.forces[: k + 1].count(force))
        for k, (force, sense) in enumerate(zip(circles.forces, circles.senses, strict=True))
    )
    return MachineTest("study", machine, setup, runs)
