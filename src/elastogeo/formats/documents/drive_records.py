"""Columns of a log on one clock -> the record of every feed drive whose effort is in it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from elastogeo.drive import (
    DriveRecord,
    FeedDrive,
    differentiate,
    effort_from_current,
    gain,
    smoothed,
    standing,
    window_of,
)
from elastogeo.errors import FormatError, InputError
from elastogeo.formats.channels import OnOneClock
from elastogeo.machine import Array

Centre = Annotated[tuple[float, float], "mm"]

SHARE_OF_SAMPLING, HIGHEST = 0.1, 30.0
"""The cut-off of the differentiator where none is given: this share of the sampling rate, at most so many Hz."""


@dataclass(frozen=True, slots=True)
class LoadDocument:
    """One entry of the table `loads`: a radial load of unknown size on a circular path (Eqs. 6.7, 6.8).

    Attributes
    ----------
    name : str
        Of the load; runs of one engagement share it.
    runs : tuple of str
        Runs that it acts in.
    centre : tuple of 2 float [mm]
        Of the circle, in positions of the axes.
    axes : tuple of 2 str
        Of the plane of the circle.
    """

    name: str
    runs: tuple[str, ...]
    centre: Centre = (0.0, 0.0)
    axes: tuple[str, ...] = ("X", "Y")

    def __post_init__(self) -> None:
        """Refuse a plane that is none."""
        if len(self.axes) != 2 or self.axes[0] == self.axes[1]:
            raise InputError(f"the load {self.name!r} acts in the plane of two axes; got {', '.join(self.axes)}")


def records_of(
    run: str, found: OnOneClock, drives: Mapping[str, FeedDrive], wanted: Sequence[str], cutoff: float | None
) -> tuple[list[DriveRecord], list[str]]:
    """The record of every axis whose effort is in a log, and what was done."""
    columns, source = found.table.columns, found.table.source
    records, notes = [], []
    for axis in _axes(columns):
        if wanted and axis not in wanted:
            continue
        effort, unit = _effort(axis, found, drives)
        record, said = _record(run, axis, found, effort, unit, cutoff, source)
        records.append(record)
        notes += said
    if not records and not wanted:
        raise FormatError(
            f"{source}: no channel is the current, torque or force of a drive; name them current_x, torque_x or force_x "
            f"with their unit, or map them in a drive file (drive.toml) under [[channels]]{_left_out(found)}"
        )
    return records, notes


def _axes(columns: Mapping[str, Array]) -> list[str]:
    """Axes that an effort is recorded of."""
    split = [name.rpartition("_") for name in columns]
    return list(dict.fromkeys(axis.upper() for kind, _, axis in split if kind in ("current", "torque", "force")))


def _effort(axis: str, found: OnOneClock, drives: Mapping[str, FeedDrive]) -> tuple[Array, str]:
    """Effort of a drive and its unit: what is recorded nearest to a torque."""
    columns, named = found.table.columns, axis.lower()
    for kind, unit in (("torque", "N mm"), ("force", "N")):
        name = f"{kind}_{named}"
        if name in columns:
            return columns[name], "%" if name in found.percent else unit
    current, drive = columns[f"current_{named}"], drives.get(axis)
    unit = "%" if f"current_{named}" in found.percent else "A"
    if drive is None:
        return current, unit
    if drive.motor_constant is None:
        return drive.sense * current, unit
    if unit == "%":
        raise FormatError(
            f"{found.table.source}: current_{named} is in % of a rated current, but the drive of axis {axis} has a motor "
            f"constant; write rated_current_A under its [[channels]], or leave the constant out"
        )
    return effort_from_current(drive, current), "N" if drive.force_constant is not None else "N mm"


def _left_out(found: OnOneClock) -> str:
    """What was said of channels that are not there."""
    said = [sentence for sentence in found.report if "left out" in sentence or "not taken" in sentence]
    return f" ({'; '.join(said)})" if said else ""


def _record(
    run: str, axis: str, found: OnOneClock, effort: Array, unit: str, cutoff: float | None, source: str
) -> tuple[DriveRecord, list[str]]:
    """One record: the motion from its own channels, or from the highest derivative that is there."""
    columns, named = found.table.columns, axis.lower()
    time = columns["time"]
    position, velocity, acceleration = (columns.get(f"{kind}_{named}") for kind in ("position", "velocity", "acceleration"))
    if velocity is not None and acceleration is not None:
        if position is None:
            position = _integrated(time, velocity)
        return DriveRecord(run, axis, time, position, velocity, acceleration, effort, effort_unit=unit), []
    from_velocity = velocity is not None
    known = velocity if velocity is not None else position
    if known is None:
        raise FormatError(
            f"{source}: has the effort of axis {axis}, but neither its position nor its velocity; map position_{named}, or "
            f"leave the axis out with axes"
        )
    chosen = cutoff or min(SHARE_OF_SAMPLING / found.step, HIGHEST)
    try:
        made = differentiate(time, known, chosen)
        smooth = smoothed(time, effort, chosen)
    except InputError as error:
        raise FormatError(f"{source}, axis {axis}: {error}") from None
    keep = ~made.edge
    if keep.sum() < 2:
        raise FormatError(
            f"{source}, axis {axis}: no sample is far enough from an end for a cut-off of {chosen:.3g} Hz; record longer"
        )
    if from_velocity:
        # Segments too short for the filter have no number; their samples are left out below.
        where = _integrated(time, np.nan_to_num(made.position)) if position is None else position
        position, velocity, acceleration = where, made.position, made.velocity
    else:
        position, velocity, acceleration = made.position, made.velocity, made.acceleration
    path = _integrated(time, known) if from_velocity else known
    at_rest = standing(time, path, made.position if from_velocity else made.velocity, window_of(found.step, chosen))
    derivative = 1 if from_velocity else 2
    left = gain(chosen, found.step, chosen, derivative) / gain(chosen, found.step, chosen, 0)
    note = (
        f"axis {axis}: {'acceleration' if from_velocity else 'velocity and acceleration'} by differences after a zero-phase "
        f"low-pass of {chosen:.3g} Hz, through which the effort goes as well; at that frequency the acceleration keeps "
        f"{100 * left:.2f} % of what the effort does, so the inertia is too large by {100 * (1 / left - 1):.2f} % there and "
        f"by less below; {int((~keep).sum())} samples near the ends are left out"
    )
    record = DriveRecord(
        run,
        axis,
        time[keep],
        position[keep],
        velocity[keep],
        acceleration[keep],
        smooth[keep],
        effort_unit=unit,
        cutoff=chosen,
        standing=at_rest[keep],
    )
    return record, [note]


def _integrated(time: Array, velocity: Array) -> Array:
    """Position relative to the first sample, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum(np.diff(time) * (velocity[1:] + velocity[:-1]) / 2)])


def loaded(record: DriveRecord, others: Sequence[DriveRecord], loads: Sequence[LoadDocument]) -> DriveRecord:
    """The record with the direction patterns of the loads that act in its run on its axis."""
    acting = [load for load in loads if record.run in load.runs and record.axis in load.axes]
    if not acting:
        return record
    patterns = {}
    for load in acting:
        pair = [next((other for other in others if other.axis == axis), None) for axis in load.axes]
        if any(other is None or not np.array_equal(other.time, record.time) for other in pair):
            raise FormatError(
                f"run {record.run}: the load {load.name!r} needs the positions of {' and '.join(load.axes)} at the same "
                f"times"
            )
        x, y = (other.position - c for other, c in zip(pair, load.centre, strict=True) if other is not None)
        radius = np.hypot(x, y)
        if not radius.all():
            raise FormatError(
                f"run {record.run}: the path goes through the centre of the load {load.name!r}; correct centre_mm"
            )
        patterns[load.name] = (x, y)[load.axes.index(record.axis)] / radius
    return replace(record, disturbance=patterns)
