"""What a static test says: beside the joint compliances, that which its own instrument shows at a glance (thesis 6.2).

* `static-force`: hysteresis and static compliance of every run, the straight line through all runs of a place, and, where
  the runs carry positions of the loaded axis, where in its drive it yields;
* `displacement-probes`: the Cartesian compliance and stiffness, its symmetry, its principal directions;
* `sensor-frame`: the twist of the tool at every load step, and the sensor that stands out.

The columns of positions are `command_x`, `position_x` (motor encoder) and `scale_x`, for the axis X. A static test stands
still: without a column of the command it counts as constant.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.identification import identify_observed
from elastogeo.identification.question import with_stated
from elastogeo.identification.result import Identification
from elastogeo.identification.static_tests.by_run import Moved, moved_observations, widened
from elastogeo.identification.static_tests.cartesian import CartesianCompliance, cartesian_of, with_influences
from elastogeo.identification.static_tests.drive_train import FEEDBACKS, OnAxis, OnAxisRecord, where_in_the_drive
from elastogeo.identification.static_tests.hysteresis import hysteresis
from elastogeo.identification.static_tests.principal import Principal
from elastogeo.identification.static_tests.result import (
    Cartesian,
    LoadedPlace,
    LoadedRun,
    LoadStep,
    StaticResults,
    TwistPlace,
    TwistRun,
)
from elastogeo.identification.static_tests.straight_line import static_line
from elastogeo.identification.static_tests.verdict import loading_checks, probe_checks, twist_checks
from elastogeo.machine import Array, Machine, loop_frames
from elastogeo.observe import (
    DisplacementProbes,
    MachineTest,
    Observations,
    Run,
    SensorFrame,
    SensorTwist,
    StaticForce,
    sensor_twist,
)

ALONG = 0.999
"""Cosine from which two directions count as one: 2.6 degrees, a thousandth of the force."""

ACROSS = 0.01
"""Cosine below which a sensor that reads across a force gives it no sense."""

STEP = 0.01
"""Share of a run's greatest force within which readings in succession are of one load step."""

MOST_MOTION = 5.0
"""By how much [mm] an axis that stands still may be seen to move: more is a wrong unit, or a motion."""

SETUP = {f"E_{axis}{point}0" for axis in "XYZ" for point in "tw"} | {"E_R0"}
"""Parameters that are zeros of sensors: who asks for one did not zero them without load."""


def evaluate_static(test: MachineTest, feedback: str = "motor") -> StaticResults:
    """What a static test says.

    Parameters
    ----------
    test : MachineTest
        With one of the set-ups `static-force`, `displacement-probes`, `sensor-frame`.
    feedback : str
        What the loaded axis closes its position loop on, `motor` encoder or `scale`; it matters only where runs carry
        positions of the axis.

    Raises
    ------
    InputError
        If the test has another instrument, or a run cannot be evaluated.
    UnsupportedError
        If the joints cannot be identified at all.
    """
    if test.setup.extra not in _EVALUATED:
        raise InputError(_of_another_instrument(test))
    if feedback not in FEEDBACKS:
        raise InputError(f"a position loop is closed on {feedback!r}; say {' or '.join(FEEDBACKS)}")
    observed = test.observations()
    found = shown_by_instrument(test, identify_observed(test, observed), observed, feedback)
    return replace(found, verdict=(*found.verdict, *found.joints.verdict))


def shown_by_instrument(
    test: MachineTest, joints: Identification, observed: Sequence[Observations], feedback: str = "motor"
) -> StaticResults:
    """What the instrument shows by itself, beside the joints that were identified from the same observations."""
    moved = tuple(moved_observations(with_stated(test, observed)))
    return _EVALUATED[test.setup.extra](test, joints, observed, moved, feedback)


def _of_cycles(
    test: MachineTest, joints: Identification, observed: Sequence[Observations], moved: Sequence[Moved], feedback: str
) -> StaticResults:
    known = cast("StaticForce", test.setup).direction is not None

    def places_of(seen: Sequence[Observations]) -> tuple[LoadedPlace, ...]:
        return _places(test.machine, test.runs, seen, known=known, feedback=feedback)

    places = widened(places_of(observed), [places_of(one.observed) for one in moved], _freedoms(moved))
    return StaticResults(joints, places=places, verdict=loading_checks(places))


def _of_probes(
    test: MachineTest, joints: Identification, observed: Sequence[Observations], moved: Sequence[Moved], _: str
) -> StaticResults:
    probes = len(cast("DisplacementProbes", test.setup).probes)
    zeroed = SETUP.isdisjoint(joints.confounding.labels)

    def compliance_of(seen: Sequence[Observations]) -> CartesianCompliance:
        return cartesian_of(test.machine, seen, sensors=0 if zeroed else probes)

    compliance = with_influences(compliance_of(observed), [compliance_of(one.observed) for one in moved], _freedoms(moved))
    found = _cartesian(compliance, zeroed)
    return StaticResults(joints, cartesian=found, verdict=probe_checks(found))


def _of_frame(
    test: MachineTest, joints: Identification, observed: Sequence[Observations], moved: Sequence[Moved], _: str
) -> StaticResults:
    setup = cast("SensorFrame", test.setup)
    twists, refusal = _twists(setup, observed, test.resolution)

    def places_of(seen: Sequence[Observations]) -> tuple[TwistPlace, ...]:
        return _twist_places(test.machine, _twists(setup, seen, test.resolution)[0], seen, known=setup.direction is not None)

    places = widened(places_of(observed), [places_of(one.observed) for one in moved], _freedoms(moved))
    return StaticResults(
        joints, twists=twists, twist_places=places, refusal=refusal, verdict=twist_checks(twists, places, refusal)
    )


def _freedoms(moved: Sequence[Moved]) -> tuple[float, ...]:
    return tuple(one.degrees_of_freedom for one in moved)


_EVALUATED = {"loading-cycles": _of_cycles, "cartesian-stiffness": _of_probes, "twist": _of_frame}
"""How each kind of extra result is made."""


def _of_another_instrument(test: MachineTest) -> str:
    name = test.instrument
    command = "stiffness" if name == "ball-roller" else "identify"
    return (
        f"test {test.name!r} was made with a {name}; a static test is made with static-force, displacement-probes or "
        f"sensor-frame. For this one use: elastogeo {command}"
    )


def _places(
    machine: Machine, runs: Sequence[Run], observed: Sequence[Observations], *, known: bool, feedback: str
) -> tuple[LoadedPlace, ...]:
    """Runs by the place where the machine stands and the line of the force."""
    groups = _grouped(observed, known=known)
    return tuple(
        _place(machine, direction, [(runs[k], observed[k]) for k in members], feedback) for direction, members in groups
    )


def _grouped(observed: Sequence[Observations], *, known: bool) -> list[tuple[Array, list[int]]]:
    """Which runs load the machine at one place along one line, and the direction of that line."""
    groups: list[tuple[Array, list[int]]] = []
    for k, seen in enumerate(observed):
        line = _line_of(seen, known=known)
        for direction, members in groups:
            same = np.allclose(observed[members[0]].commands[0], seen.commands[0], rtol=0, atol=1e-6)
            if same and abs(direction @ line) > ALONG:
                members.append(k)
                break
        else:
            groups.append((line, [k]))
    return groups


def _line_of(seen: Observations, *, known: bool) -> Array:
    """Unit vector, shape (3,), of the line along which a run's force acts; its sense is that of the recorded force.

    A force that is recorded by components has no sense of its own: it counts as positive the way the sensor reads.
    """
    force, sensor = seen.wrench[:, :3], seen.direction[0, :3]
    size = float(np.linalg.norm(force, axis=1).max())
    if not size:
        return np.asarray(sensor)
    line = np.linalg.svd(force, full_matrices=False)[2][0]
    across = float(np.linalg.norm(force - np.outer(force @ line, line), axis=1).max())
    if across > np.sqrt(1 - ALONG**2) * size:
        raise InputError(
            f"run {seen.run!r}: its force does not keep to a line, it departs by {across:.3g} N of {size:.3g} N; a static "
            f"force has one direction a run: make a run of each, or mend the load cell's zero"
        )
    read = float(sensor @ line)
    across_sensor = float(line[np.argmax(np.abs(line))])
    sense = float(force @ line @ seen.pose) if known else read if abs(read) > ACROSS else across_sensor
    return np.asarray(line if sense > 0 else -line) + 0.0  # no minus zeros


def _place(machine: Machine, direction: Array, members: Sequence[tuple[Run, Observations]], feedback: str) -> LoadedPlace:
    """All that the runs of a place say."""
    first = members[0][1]
    cosine = float(first.direction[0, :3] @ direction)
    sense = -1.0 if cosine < -ALONG else 1.0
    loaded = tuple(_loaded(seen.run, seen.wrench[:, :3] @ direction, sense * seen.reading) for _, seen in members)
    line, refusal = None, ""
    try:
        line = static_line(
            np.concatenate([run.force for run in loaded]),
            np.concatenate([run.displacement for run in loaded]),
            [run.run for run in loaded for _ in run.force],
        )
    except UnsupportedError as error:
        refusal = str(error)
    drive, drive_refusal = None, ""
    try:
        drive = _drive(machine, direction, members, feedback)
    except UnsupportedError as error:
        drive_refusal = str(error)
    return LoadedPlace(
        commands=_standing(machine, first),
        direction=direction,
        along=abs(cosine) > ALONG,
        runs=loaded,
        line=line,
        refusal=refusal,
        drive=drive,
        drive_refusal=drive_refusal,
    )


def _loaded(run: str, force: Array, displacement: Array) -> LoadedRun:
    try:
        return LoadedRun(run, force, displacement, hysteresis(force, displacement))
    except UnsupportedError as error:
        return LoadedRun(run, force, displacement, None, str(error))


def _drive(machine: Machine, direction: Array, members: Sequence[tuple[Run, Observations]], feedback: str) -> OnAxis | None:
    """Where the loaded axis yields; None if the force is along none, or its positions were not recorded."""
    first = members[0][1]
    frames = loop_frames(machine, first.commands[:1], first.tool)
    for joint in machine.joints:
        axis = frames.joints[joint.name].motion.rotation[0][:, joint.direction]
        if joint.is_rotary or abs(direction @ axis) <= ALONG:
            continue
        columns = {part: f"{part}_{joint.name.lower()}" for part in ("command", "position", "scale", "current")}
        with_any = [pair for pair in members if {columns["position"], columns["scale"]} & set(pair[0].columns)]
        if not with_any:
            continue
        current = _of_all([run for run, _ in with_any], columns.pop("current"))
        there = {part: _positions([run for run, _ in with_any], name) for part, name in columns.items()}
        force = np.concatenate([seen.wrench[:, :3] @ axis for _, seen in with_any])
        reads = float(first.direction[0, :3] @ axis)
        deflection = np.sign(reads) * np.concatenate([seen.reading for _, seen in with_any])
        record = OnAxisRecord(
            axis=joint.name,
            force=force,
            command=np.zeros(len(force)) if there["command"] is None else there["command"],
            motor=there["position"],
            scale=there["scale"],
            deflection=deflection if abs(reads) > ALONG else None,
            current=current,
            run=[seen.run for _, seen in with_any for _ in range(len(seen))],
        )
        return where_in_the_drive(record, feedback)
    return None


def _of_all(runs: Sequence[Run], column: str) -> Array | None:
    """A column of all runs one after the other; None if no run has it."""
    without = [run.name for run in runs if column not in run.columns]
    if len(without) == len(runs):
        return None
    if without:
        raise InputError(
            f"run {without[0]!r} lacks the column {column} that other runs of this place have; record it in all, or in none"
        )
    return np.concatenate([np.asarray(run.columns[column], dtype=float) for run in runs])


def _positions(runs: Sequence[Run], column: str) -> Array | None:
    """As `_of_all`, of positions at standstill."""
    positions = _of_all(runs, column)
    for run in runs if positions is not None else ():
        moved = float(np.ptp(run.columns[column]))
        if moved > MOST_MOTION:
            raise InputError(
                f"run {run.name!r}: {column} moves by {moved:.4g} mm; a static test stands still: are they micrometres "
                f"given as millimetres?"
            )
    return positions


def _cartesian(compliance: CartesianCompliance, zeroed: bool) -> Cartesian:
    """The Cartesian compliance and all that can be had of it."""
    stiffness = uncertainty = symmetry = None
    principal: tuple[Principal, ...] = ()
    refusals = []
    try:
        principal = compliance.principal()
        stiffness, covariance = compliance.stiffness()
        uncertainty = np.sqrt(np.diag(covariance)).reshape(3, 3)
    except UnsupportedError as error:
        refusals.append(str(error))
    try:
        symmetry = compliance.symmetry()
    except UnsupportedError as error:
        refusals.append(str(error))
    return Cartesian(compliance, zeroed, stiffness, uncertainty, symmetry, principal, "; ".join(refusals[:1]))


def _twists(
    setup: SensorFrame, observed: Sequence[Observations], resolution: float | None
) -> tuple[tuple[TwistRun, ...], str]:
    """The twist of every run, or why there is none."""
    deviation = None
    if len(setup.sensors) == 6:
        if not resolution:
            return (), "six sensors leave no residual: give the resolution of the readings, or add a sensor"
        deviation = resolution / np.sqrt(12)
    try:
        return tuple(_twist(setup, seen, deviation) for seen in observed), ""
    except UnsupportedError as error:
        return (), str(error)


def _twist(setup: SensorFrame, seen: Observations, deviation: float | None) -> TwistRun:
    readings = np.array(np.split(seen.reading, len(setup.sensors))).T
    force = np.sign(seen.pose[: len(readings)]) * np.linalg.norm(seen.wrench[: len(readings), :3], axis=1)
    found = sensor_twist(setup.sensors, readings, deviation)
    return TwistRun(seen.run, force, found, tuple(_steps(force, found)))


def _twist_places(
    machine: Machine, twists: Sequence[TwistRun], observed: Sequence[Observations], *, known: bool
) -> tuple[TwistPlace, ...]:
    """Twist per force by place and line of the force; of those with one force only, none."""
    places = []
    for direction, members in _grouped(observed, known=known) if twists else ():
        runs = [twists[k] for k in members]
        force = np.concatenate([run.force for run in runs])
        twist, names = np.concatenate([run.twist.twist for run in runs]), [run.run for run in runs for _ in run.force]
        try:
            lines = [static_line(force, component, names) for component in twist.T]
        except UnsupportedError:
            continue
        compliance = tuple(line.compliance for line in lines)
        at = _standing(machine, observed[members[0]])
        places.append(TwistPlace(at, direction, tuple(run.run for run in runs), compliance, lines[0].counted))
    return tuple(places)


def _standing(machine: Machine, seen: Observations) -> dict[str, float]:
    return {axis: float(value) for axis, value in zip(machine.axes, seen.commands[0], strict=True)}


def _steps(force: Array, found: SensorTwist) -> Iterator[LoadStep]:
    """Means of readings in succession whose force stays where it is."""
    band = STEP * float(np.abs(force).max())
    first = 0
    for last in range(1, len(force) + 1):
        if last < len(force) and abs(force[last] - force[first]) <= band:
            continue
        count = last - first
        yield LoadStep(
            force=float(force[first:last].mean()),
            readings=count,
            twist=found.twist[first:last].mean(axis=0),
        )
        first = last
