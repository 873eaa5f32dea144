"""The readings that given parameter values cause: to first order, and exactly."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array, LoopFrames, Machine, Site, loop_frames
from elastogeo.observe import Observations, Run, Setup
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source

BLOCK_READINGS = 8192
"""Readings in a block: enough that what is done once a block hardly counts, few enough for the cache, and for the C library
to keep their memory for the next block rather than give it back to the system."""


def design_rows(sources: Sequence[Source], machine: Machine, observations: Observations) -> Array:
    """Rows `[A | y]` of the linear model.

    Parameters
    ----------
    sources : sequence of Source, length p
    machine : Machine
    observations : Observations
        m readings.

    Returns
    -------
    array, shape (m, p + 1), Fortran order
        Change of each reading per unit of each parameter (Eq. 4.13 in closed form), then the readings.
    """
    situation = Situation(machine, observations)
    rows = np.empty((len(observations), len(sources) + 1), order="F")
    for k, source in enumerate(sources):
        rows[:, k] = source.column(situation)
    rows[:, -1] = observations.reading
    return rows


def load_derivative(sources: Sequence[Source], machine: Machine, observations: Observations, change: Array) -> Array:
    """Derivative of the design by the loads, along a change of the wrench.

    Parameters
    ----------
    sources : sequence of Source, length p
    machine : Machine
    observations : Observations
        m readings.
    change : array, shape (m, 6) [N, N mm]
        Of the wrench, per unit of whatever changes it.

    Returns
    -------
    array, shape (m, p)
        Exact for geometry and for compliances, whose columns are linear in the load.

    Raises
    ------
    UnsupportedError
        If a source's column is another function of the load.
    """
    other = [source.name for source in sources if source.force_degree not in (0.0, 1.0)]
    if other:
        raise UnsupportedError(
            f"the uncertainty of single loads is propagated through constant compliances only; leave out {', '.join(other)}"
        )
    situation = Situation(machine, replace(observations, wrench=change))
    unloaded = Situation(machine, replace(observations, wrench=np.zeros_like(change))) if situation.weights else None
    columns = np.zeros((len(observations), len(sources)))
    for k, source in enumerate(sources):
        if source.force_degree:
            columns[:, k] = source.column(situation)
            if unloaded is not None:  # weights do not change with the wrench
                columns[:, k] -= source.column(unloaded)
    return columns


def design_blocks(
    sources: Sequence[Source], machine: Machine, setup: Setup, runs: Iterable[Run], readings: int = BLOCK_READINGS
) -> Iterator[Array]:
    """Rows `[A | y]` of runs of any length, block by block: the memory does not grow with the readings.

    `factor_blocks` takes them as they come. The runs may come as they are recorded, and a long run in pieces of one name;
    it is for instruments that observe every reading by itself.

    Parameters
    ----------
    sources : sequence of Source, length p
    machine : Machine
    setup : Setup
        Of the instrument.
    runs : iterable of Run
    readings : int
        In a block, at most.

    Yields
    ------
    array, shape (readings or fewer, p + 1), Fortran order
        As `design_rows`; the taker may overwrite it.
    """
    for run in runs:
        length = max(map(len, run.columns.values()), default=0)
        for first in range(0, max(length, 1), readings):
            part = {quantity: values[first : first + readings] for quantity, values in run.columns.items()}
            yield design_rows(sources, machine, setup.observe(machine, replace(run, columns=part)))


def column_ceilings(sources: Sequence[Source], machine: Machine, observations: Observations) -> Array:
    """The length that each column of the design would have if no moment and no component cancelled, shape (p,).

    What is 1e-12 of that is rounding error: a source that moves no reading, whatever its unit.
    """
    situation = Situation(machine, observations)
    frames = situation.frames
    loaded = [frames.carried_at(name)[0] for name in (*frames.joints, *frames.places)]
    lever = max(float(np.linalg.norm(frames.point - frame.origin, axis=1).max()) for frame in loaded)
    carried = [float(np.abs(load[:, :3]).max()) for load in situation.weights.values()]
    force = float(situation.force().max()) + max(carried, default=0.0)
    moment = force * lever + float(np.abs(observations.wrench[:, 3:]).max())

    def ceiling(source: Source) -> float:
        arm = lever if source.component >= 3 else 1.0
        if source.load is None:
            return arm * float(np.abs(source.driver(situation)).max())
        load = moment if source.load >= 3 else force
        return float(arm * load ** min(source.force_degree, 1.0) * force ** max(source.force_degree - 1.0, 0.0))

    return np.asarray(np.array([ceiling(source) for source in sources]) * np.sqrt(len(observations)))


def linear_response(values: Mapping[Source, float], machine: Machine, observations: Observations) -> Array:
    """Readings, shape (m,) [mm or rad], that parameter values cause to first order (Eqs. 4.13, 5.15)."""
    situation = Situation(machine, observations)
    return sum((value * source.column(situation) for source, value in values.items()), np.zeros(len(observations)))


def exact_response(values: Mapping[Source, float], machine: Machine, observations: Observations) -> Array:
    """Readings, shape (m,) [mm or rad], that parameter values cause, by exact products of transforms with finite rotations.

    The loads are those of the nominal pose; the deflections and errors they cause may have any size. It is the simulator,
    and the judge of `linear_response`. An instrument across a span of joints sees the loop as if it were rigid elsewhere.
    """
    situation = Situation(machine, observations)
    twists = site_twists(values.items(), situation)
    frames = loop_frames(machine, observations.commands, observations.tool, twists)
    none = np.zeros((1, 6))
    tool = frames.point + frames.tool.vector(twists.get(("tool", ""), none)[:, :3])
    ball = frames.workpiece.point(observations.workpiece + twists.get(("workpiece", ""), none)[:, :3])
    at_reading = twists.get(("reading", ""), none)[:, 0]
    if np.isfinite(observations.length):
        return np.asarray(np.linalg.norm(tool - ball, axis=1) - observations.length + at_reading)
    nominal = situation.frames.point - situation.frames.workpiece.point(observations.workpiece)
    displacement = np.einsum("mi,mi->m", observations.direction[:, :3], tool - ball - nominal)
    return np.asarray(displacement + _rotation_seen(frames, situation) + at_reading)


def exact_points(values: Mapping[Source, float], machine: Machine, observations: Observations) -> Array:
    """Where the tool really is, shape (m, 3) [mm], in the frame of the workpiece as it really stands.

    By exact products of transforms, as `exact_response`; readings, directions and set-ups of instruments do not count.
    """
    situation = Situation(machine, observations)
    machine_alone = ((source, value) for source, value in values.items() if not source.of_test)
    frames = loop_frames(machine, observations.commands, observations.tool, site_twists(machine_alone, situation))
    found = frames.workpiece.components(frames.point - frames.workpiece.origin)
    return np.asarray(np.broadcast_to(found, (len(observations), 3)))


def _rotation_seen(frames: LoopFrames, situation: Situation) -> Array | float:
    """What an angular direction sees, shape (m,) [rad]: the rotation of the tool relative to the workpiece."""
    about = situation.observations.direction[:, 3:]
    if not about.any():
        return 0.0
    from scipy.spatial.transform import Rotation  # here: only a simulated sensor of angles needs it

    nominal = situation.frames
    tool = frames.tool.rotation @ nominal.tool.rotation.swapaxes(1, 2)
    workpiece = frames.workpiece.rotation @ nominal.workpiece.rotation.swapaxes(1, 2)
    turned = Rotation.from_matrix(tool @ workpiece.swapaxes(1, 2)).as_rotvec()
    return np.asarray(np.einsum("mi,mi->m", about, np.broadcast_to(turned, about.shape)))


def site_twists(values: Iterable[tuple[Source, float]], situation: Situation) -> dict[Site, Array]:
    """Twist, shape (m, 6) [mm, rad], that parameter values cause at each site that the instrument sees."""
    twists: dict[Site, Array] = {}
    for source, value in values:
        if not situation.sees(source.site):
            continue
        twist = twists.setdefault(source.site, np.zeros((len(situation.observations), 6)))
        twist[:, source.component] += value * source.driver(situation)
    return twists
