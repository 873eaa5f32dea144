"""Where a roller went about a ball, as the encoders say, and what its drives took."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.drive import DriveRecord, FeedDrive, differentiate, effort_from_current
from elastogeo.errors import InputError
from elastogeo.machine import Array, LoopFrames, Machine, loop_frames, workpiece_ball
from elastogeo.observe.circle import Circle, plane_directions
from elastogeo.observe.run import Run

MOST_ENGAGEMENT = 0.05
"""Share of the radius that an engagement may be: beyond it a unit or a centre is wrong."""


@dataclass(frozen=True, slots=True)
class Track:
    """One run of the roller about the ball, at m samples.

    Attributes
    ----------
    run : str
    time : array, shape (m,) [s]
    angle : array, shape (m,) [rad]
        Of the line of centres in the plane of the circle, going on beyond a turn.
    engagement : array, shape (m,) [mm]
        By how much the encoders say that the roller stands in the ball (Eq. 6.1).
    commands, velocity, acceleration : array, shape (m, n) [mm, mm/s, mm/s^2; rad for rotary axes]
        As the encoders say.
    direction : array, shape (m, 3)
        Unit vector from the ball to the roller, foundation components.
    records : mapping of str to DriveRecord
        By axis.
    """

    run: str
    time: Array
    angle: Array
    engagement: Array
    commands: Array
    velocity: Array
    acceleration: Array
    direction: Array
    records: Mapping[str, DriveRecord]

    @property
    def push(self) -> Array:
        """Unit wrench of the ball on the roller, and sensitive direction, shape (m, 6)."""
        return np.column_stack([self.direction, np.zeros_like(self.direction)])


def track_of(
    machine: Machine, run: Run, circle: Circle, drives: Sequence[FeedDrive], cutoff: float, tool: Array | None = None
) -> Track:
    """The track of a run, from its recorded positions.

    Parameters
    ----------
    machine : Machine
    run : Run
        With the columns `time`, and `position_x`, `current_x` of every driven axis x; an axis without positions stands at
        the centre's.
    circle : Circle
        Its radius is the distance of the centres at which ball and roller just touch.
    drives : sequence of FeedDrive
    cutoff : float [Hz]
        Of the derivatives of the positions.
    tool : array, shape (3,) [mm], optional

    Raises
    ------
    InputError
        If the clock is not uniform, the run is too short, or the roller was nowhere near the ball.
    """
    time = run.columns["time"]
    commands = np.tile([circle.centre.get(axis, 0.0) for axis in machine.axes], (len(time), 1))
    velocity, acceleration = np.zeros_like(commands), np.zeros_like(commands)
    whole = np.ones(len(time), dtype=bool)
    for k, axis in enumerate(machine.axes):
        position = run.columns.get(f"position_{axis.lower()}")
        if position is None:
            continue
        moved = differentiate(time, position, cutoff)
        # The low-pass would take its part of the radius: it is for the derivatives alone.
        commands[:, k], velocity[:, k], acceleration[:, k] = position, moved.velocity, moved.acceleration
        whole &= ~moved.edge & np.isfinite(moved.acceleration)
    if not whole.any():
        raise InputError(f"run {run.name!r} is too short for a cut-off of {cutoff:g} Hz; record at least a turn")
    commands, velocity, acceleration = commands[whole], velocity[whole], acceleration[whole]

    def record(drive: FeedDrive) -> DriveRecord:
        joint, current = machine.index(drive.axis), run.columns[f"current_{drive.axis.lower()}"][whole]
        return DriveRecord(
            run=run.name,
            axis=drive.axis,
            time=time[whole],
            position=commands[:, joint],
            velocity=velocity[:, joint],
            acceleration=acceleration[:, joint],
            effort=effort_from_current(drive, current),
            effort_unit="N mm" if drive.force_constant is None else "N",
        )

    frames = loop_frames(machine, commands, tool)
    apart = frames.point - frames.workpiece.point(workpiece_ball(machine, circle.centre, tool))
    distance = np.linalg.norm(apart, axis=1)
    engagement = circle.radius - distance
    _check_near(run.name, engagement, circle.radius)
    direction = apart / distance[:, np.newaxis]
    return Track(
        run=run.name,
        time=time[whole],
        angle=_angle(direction, frames, circle),
        engagement=engagement,
        commands=commands,
        velocity=velocity,
        acceleration=acceleration,
        direction=direction,
        records={drive.axis: record(drive) for drive in drives},
    )


def moving(track: Track, least_speed: float) -> Track:
    """The samples of a track at which all its drives move, so that the friction of each is known [mm/s]."""
    fast = np.all([np.abs(record.velocity) > least_speed for record in track.records.values()], axis=0)
    if np.count_nonzero(fast) < 2:
        raise InputError(f"run {track.run!r} has no samples at which all drives move faster than {least_speed:g} mm/s")
    along_track = ("time", "angle", "engagement", "commands", "velocity", "acceleration", "direction")
    of_drive = ("time", "position", "velocity", "acceleration", "effort")
    return replace(
        track,
        **{name: getattr(track, name)[fast] for name in along_track},
        records={
            axis: replace(record, **{name: getattr(record, name)[fast] for name in of_drive})
            for axis, record in track.records.items()
        },
    )


def _angle(direction: Array, frames: LoopFrames, circle: Circle) -> Array:
    """Angle of the line of centres in the plane of the circle, shape (m,) [rad]."""
    first, second = plane_directions(circle.plane)
    if circle.in_workpiece:
        direction = frames.workpiece.components(direction)
    return np.unwrap(np.arctan2(direction @ second, direction @ first))


def _check_near(run: str, engagement: Array, radius: float) -> None:
    worst = float(np.abs(engagement).max())
    if worst > MOST_ENGAGEMENT * radius:
        raise InputError(
            f"run {run!r}: the encoders put the roller up to {worst:g} mm from its circle of {radius:g} mm about the ball; "
            f"check units, the centre and the radius, and cut the way to and from the ball off the run"
        )
