"""The force of a ball on the roller that is pressed against it, from the currents of the drives that press it.

What a motor takes beyond its own torque balance holds the reaction of the force (Eqs. 6.6, 6.10, 6.11); by virtual work the
reactions of all drives give the force at the tool (6.15), whose part along the line of centres is the contact's: the roller
rolls, so that it takes no other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from elastogeo.drive import (
    FeedDrive,
    TorqueBalance,
    effort_from_force,
    force_from_effort,
    joint_forces,
    motion_columns,
    tool_force,
)
from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array, Machine
from elastogeo.observe.observations import ObservedInfluence
from elastogeo.observe.rollers.track import Track

LOSSES = "losses when driven back"
"""The influence of losses that are not stated: one rule gives those of all drives, so that they are off together."""

_WORST_CONDITION = 1e4
"""Of the harmonics on the samples that count, scaled: beyond it a gap in them is so wide that they would be made up."""


@dataclass(frozen=True, slots=True)
class ContactForce:
    """The force along the line of centres.

    Attributes
    ----------
    force : array, shape (m,) [N]
        Positive where the ball pushes the roller away.
    scatter : float [N]
        Root mean square of what the harmonics leave of the samples.
    influences : tuple of (label, standard uncertainty, degrees of freedom, array of shape (m,))
        Change of the force per unit of what is uncertain in the drives.
    load : mapping of str to array, shape (m,) [N mm; N of a linear motor]
        Effort of the motor of each drive that holds it, by axis, smoothed to harmonics of the turn.
    """

    force: Array
    scatter: float
    influences: tuple[tuple[str, float, float, Array], ...]
    load: Mapping[str, Array]


def contact_force(
    machine: Machine,
    track: Track,
    drives: Sequence[FeedDrive],
    balances: Mapping[str, TorqueBalance],
    harmonics: int,
    tool: Array | None = None,
) -> ContactForce:
    """The force of the contact along a track.

    Parameters
    ----------
    machine : Machine
    track : Track
    drives : sequence of FeedDrive
        Of the linear axes that press.
    balances : mapping of str to TorqueBalance
        By axis.
    harmonics : int
        Of the turn, to which the forces of the drives are smoothed over the samples at which they move fast enough; 0 for
        the samples themselves.
    tool : array, shape (3,) [mm], optional

    Raises
    ------
    UnsupportedError
        If the samples that count leave so wide a gap in the turn that its harmonics are not determined.
    """
    axes = [drive.axis for drive in drives]
    smooth = {axis: _smoother(track, axis, balances[axis].model.least_speed or 0.0, harmonics) for axis in axes}

    def along(axis: str, held: Array) -> Array:
        """The force along the line of centres, of the force [N] that one drive holds."""
        forces = np.zeros((len(held), len(axes)))
        forces[:, axes.index(axis)] = -held
        return np.asarray(np.einsum("mi,mi->m", track.direction, tool_force(machine, track.commands, forces, axes, tool)))

    force, scatter = np.zeros(len(track.angle)), 0.0
    influences: list[tuple[str, float, float, Array]] = []
    load: dict[str, Array] = {}
    losses = np.zeros(len(track.angle))
    for drive in drives:
        axis, balance, record = drive.axis, balances[drive.axis], track.records[drive.axis]
        driving = drives_against(machine, track, axis, tool)
        samples = force_from_effort(drive, balance.disturbance(record), driving)
        held = smooth[axis](samples)
        load[axis] = effort_from_force(drive, held, driving)
        scatter += float(np.mean(np.square(samples - held)[_counts(track, axis, balance.model.least_speed or 0.0)]))
        part = along(axis, held)
        force += part
        if drive.relative_uncertainty:
            influences.append((f"force per current of {axis}", drive.relative_uncertainty, np.inf, part))
        if drive.back_uncertainty:
            losses += drive.back_uncertainty * along(axis, smooth[axis](np.where(driving, 0.0, -samples)))
        columns = motion_columns(record, balance.model)[1]
        for size, freedom, change in _independent(balance):
            moved = -force_from_effort(drive, columns @ change, driving)
            influences.append((f"friction and inertia of {axis}", size, freedom, along(axis, smooth[axis](moved))))
    if any(drive.back_uncertainty for drive in drives):
        influences.append((LOSSES, 1.0, np.inf, losses))
    return ContactForce(force, float(np.sqrt(scatter)), tuple(influences), load)


def drives_against(machine: Machine, track: Track, axis: str, tool: Array | None = None) -> NDArray[np.bool_]:
    """Where the motor of an axis drives the roller against the ball, shape (m,); elsewhere the ball drives it back.

    The ball can only push the roller away. So the direction of the power follows from that of the motion alone, and no noise
    of the current decides it.
    """
    pushed = joint_forces(machine, track.commands, track.push, [axis], tool)[:, 0]
    return np.asarray(pushed * track.records[axis].velocity < 0)


def observed_influences(
    contact: ContactForce, push: Array, setup_compliance: Array, setup_uncertainty: float | None
) -> tuple[ObservedInfluence, ...]:
    """What is uncertain in drives and set-up, as it enters wrench and reading.

    Parameters
    ----------
    contact : ContactForce
        Along m samples.
    push : array, shape (m, 6)
        Unit wrench of the ball on the roller.
    setup_compliance : array, shape (m,) [mm/N]
        By which the force takes the set-up's deflection off the reading.
    setup_uncertainty : float or None [mm/N]
        Standard uncertainty of that compliance.
    """
    drives = tuple(
        ObservedInfluence(label, size, freedom, change[:, np.newaxis] * push, -setup_compliance * change)
        for label, size, freedom, change in contact.influences
    )
    if not setup_uncertainty:
        return drives
    return (*drives, ObservedInfluence("set-up compliance", setup_uncertainty, np.inf, np.zeros_like(push), -contact.force))


def _independent(balance: TorqueBalance) -> list[tuple[float, float, Array]]:
    """Independent changes of the parameters of a balance: standard deviation 1, degrees of freedom, change, shape (p,)."""
    if not balance.covariance.any():
        return []
    scale = np.sqrt(np.diag(balance.covariance))
    scale = np.where(scale > 0, scale, 1.0)
    values, vectors = np.linalg.eigh(balance.covariance / np.outer(scale, scale))
    freedom = float(np.min(balance.degrees_of_freedom))
    return [
        (1.0, freedom, scale * vector * np.sqrt(value)) for value, vector in zip(values, vectors.T, strict=True) if value > 0
    ]


def _counts(track: Track, axis: str, least_speed: float) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    return np.asarray(np.abs(track.records[axis].velocity) >= least_speed)


def _smoother(track: Track, axis: str, least_speed: float, harmonics: int) -> Callable[[Array], Array]:
    """Least squares of harmonics of the turn over the samples at which an axis moves."""
    if not harmonics:
        return lambda values: values
    order = np.arange(1, harmonics + 1)
    waves = np.outer(track.angle, order)
    basis = np.column_stack([np.ones(len(track.angle)), np.cos(waves), np.sin(waves)])
    counts = _counts(track, axis, least_speed)
    Q, R = np.linalg.qr(basis[counts])
    if len(Q) < len(R) or np.linalg.cond(R) > _WORST_CONDITION:
        raise UnsupportedError(
            f"run {track.run!r}: the samples at which {axis} moves do not determine {harmonics} harmonics of a turn; record "
            f"full turns, or set harmonics = 0 in the test's set-up to take each sample by itself"
        )
    return lambda values: basis @ solve_triangular(R, Q.T @ values[counts])
