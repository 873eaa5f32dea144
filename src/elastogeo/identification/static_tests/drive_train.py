"""Where in the drive an axis yields: servo, transmission, guideway and structure, in series (section 2.7).

A force F along an axis moves everything between the command and the tool. What each measured position adds to the one
before it, as a straight line over F, is the compliance of what lies between the two:

    command -> motor encoder      the servo (its following error)
    motor encoder -> scale        the transmission: screw, nut, coupling, bearing
    scale -> tool                 guideway and structure: the deflection at the tool less both

All in the sense of the axis: F positive where it pushes the tool to greater positions (as `drive.joint_forces` gives it),
each position as actual position of the axis, the deflection as displacement of the tool relative to the workpiece from where
the command puts it. The force must vary slowly: inertia and the lag of a moving axis are not in it.

If the position loop is closed on the scale, the servo is what the scale still departs from the command, and the
transmission is inside the loop: the motor turns further by as much as it yields, so that it does not move the tool. Its
compliance is still seen between the encoders; it is stated, and does not count in the sum.

Friction may hold an axis at rest in place of its motor. The motor's current tells: where it does not follow the force, what
departs from the command is no stiffness of the servo.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import InputError, RankError
from elastogeo.estimate import (
    Estimate,
    Factor,
    Solution,
    confounding,
    effective_degrees_of_freedom,
    factor_blocks,
    merge,
)
from elastogeo.identification.check import Check
from elastogeo.identification.static_tests.by_run import Counted, solved_by_run
from elastogeo.machine import Array

FEEDBACKS = ("motor", "scale")
"""Where the position loop of an axis may be closed: on the motor's encoder, or on a scale of the axis."""

SERVO, TRANSMISSION, STRUCTURE = "servo", "transmission", "guideway and structure"

_IN_SERIES = {"motor": ("command", "motor", "scale"), "scale": ("command", "scale")}
"""Positions from the command towards the tool, by what the position loop is closed on."""

_SPRINGS = {"motor": (SERVO, TRANSMISSION, STRUCTURE), "scale": (SERVO, STRUCTURE)}
"""What yields after each of them."""


@dataclass(frozen=True, slots=True)
class OnAxisRecord:
    """What was logged of one axis under load, reading by reading, in the order of time within a run.

    Attributes
    ----------
    axis : str
    force : array, shape (m,) [N]
        At the tool along the axis, positive towards greater positions.
    command, motor, scale : array, shape (m,) [mm], or None
        Commanded position, position by the motor's encoder through the transmission ratio, position by the linear scale.
    deflection : array, shape (m,) [mm], or None
        Of the tool relative to the workpiece, from where the command puts it, along the axis.
    velocity : array, shape (m,) [mm/s], or None
        Of the axis; with it, what changes with the direction of motion (backlash, friction) is told from the compliance.
    run : sequence of str, length m, or None
        Which run each reading is of.
    current : array, shape (m,) [A], or None
        Of the motor.
    """

    axis: str
    force: Array
    command: Array | None = None
    motor: Array | None = None
    scale: Array | None = None
    deflection: Array | None = None
    velocity: Array | None = None
    run: Sequence[str] | None = None
    current: Array | None = None

    def __post_init__(self) -> None:
        """Refuse channels that do not fit together."""
        for name in ("force", "command", "motor", "scale", "deflection", "velocity", "current"):
            channel = getattr(self, name)
            if channel is None:
                continue
            if np.shape(channel) != (len(self.force),):
                raise InputError(
                    f"axis {self.axis}: {name} has the shape {np.shape(channel)} beside {len(self.force)} forces; each "
                    f"channel needs one value per reading"
                )
            if not np.isfinite(channel).all():
                wrong = int((~np.isfinite(channel)).sum())
                raise InputError(f"axis {self.axis}: {wrong} readings of {name} are NaN or infinite; leave them out")
        if self.run is not None and len(self.run) != len(self.force):
            raise InputError(f"axis {self.axis}: {len(self.run)} names of runs beside {len(self.force)} readings")


@dataclass(frozen=True, slots=True)
class OnAxisPart:
    """One spring of the series.

    Attributes
    ----------
    names : tuple of str
        What it is; more than one name if they cannot be distinguished.
    compliance : Estimate
    acts : bool
        Whether it moves the tool quasi-statically; a transmission inside the position loop does not.
    share : float or None
        Of the whole compliance; zero if it does not act, None if the whole is not known.
    reversal : Estimate or None [mm]
        Half of what it jumps by when the motion reverses (backlash is twice that); None where it was not asked for. Of
        the servo it holds the lag of a moving axis as well (speed over position gain).
    """

    names: tuple[str, ...]
    compliance: Estimate
    acts: bool
    share: float | None
    reversal: Estimate | None

    @property
    def name(self) -> str:
        """Its names in words."""
        return " with ".join(self.names)

    def stiffness(self) -> Estimate:
        """Inverse of the compliance [N/mm]: of the servo, its stiffness at standstill.

        Raises
        ------
        UnsupportedError
            If the compliance may as well be zero: its inverse is then unbounded, as where integral action holds the axis.
        """
        return self.compliance.inverse()


@dataclass(frozen=True, slots=True)
class OnAxis:
    """Where an axis yields.

    Attributes
    ----------
    axis, feedback : str
        The position loop is closed on the `motor` encoder or on the `scale`.
    parts : tuple of OnAxisPart
        From the command to the tool.
    whole : Estimate or None
        From the command to the tool; None if the deflection was neither logged nor given.
    limits : tuple of str
        What cannot be said, and why, in sentences.
    verdict : tuple of Check
    current : Estimate or None [A/N]
        Of the motor per force; None if it was not logged.
    """

    axis: str
    feedback: str
    parts: tuple[OnAxisPart, ...]
    whole: Estimate | None
    limits: tuple[str, ...]
    verdict: tuple[Check, ...]
    current: Estimate | None = None


@dataclass(frozen=True, slots=True)
class _Lines:
    """Columns of the straight lines, their labels, and the rows of each run."""

    design: Array
    labels: tuple[str, ...]
    runs: Mapping[str, NDArray[np.intp]]


def where_in_the_drive(record: OnAxisRecord, feedback: str = "motor", whole: Estimate | None = None) -> OnAxis:
    """Split the compliance of an axis into servo, transmission, and guideway with structure.

    Parameters
    ----------
    record : OnAxisRecord
    feedback : str
        What the control closes its position loop on: `motor` encoder or `scale`.
    whole : Estimate, optional
        On-axis compliance from another test, when the deflection was not logged; it counts as independent of the record.

    Returns
    -------
    OnAxis

    Raises
    ------
    InputError
        If the feedback is unknown, the deflection is both logged and given, or nothing can be split.
    RankError
        If the force does not vary, or goes exactly with the direction of motion.
    DegreesOfFreedomError
        If there are too few readings.
    """
    if feedback not in FEEDBACKS:
        raise InputError(f"a position loop is closed on {feedback!r}; say {' or '.join(FEEDBACKS)}")
    if whole is not None and record.deflection is not None:
        raise InputError(
            f"axis {record.axis} has a logged deflection and a compliance from another test; the two would be the whole "
            f"twice, give one and compare the other with it"
        )
    chain = _chain(record, feedback)
    inside = feedback == "scale" and record.motor is not None and record.scale is not None
    if len(chain) < 2 and not inside:
        raise InputError(
            f"axis {record.axis}: the loop is closed on the {feedback}, and of the positions in series there is "
            f"{' and '.join(chain) or 'none'}; it takes two of {', '.join(_IN_SERIES[feedback])} to split anything"
        )
    lines, limits = _lines(record)
    parts, counted, total = _split(record, feedback, chain, lines, whole)
    if inside:
        fit, counted = _fitted(lines, _channel(record, "scale") - _channel(record, "motor"))
        parts.append(_part((TRANSMISSION,), fit, 0.0, acts=False))
    return OnAxis(
        axis=record.axis,
        feedback=feedback,
        parts=tuple(parts),
        whole=total,
        limits=tuple(limits + _limits(record, feedback, parts, total)),
        verdict=(_by_run(counted), _springs(parts), _apart(parts)),
        current=None if record.current is None else _fitted(lines, _channel(record, "current"))[0].estimate("compliance"),
    )


def _chain(record: OnAxisRecord, feedback: str) -> list[str]:
    """Logged positions in series; a motor inside a loop closed on the scale is none of them."""
    return [name for name in _IN_SERIES[feedback] if getattr(record, name) is not None]


def _split(
    record: OnAxisRecord, feedback: str, chain: Sequence[str], lines: _Lines, whole: Estimate | None
) -> tuple[list[OnAxisPart], Counted, Estimate | None]:
    """Parts that act, what their uncertainty assumes, and the whole."""
    places, springs = _IN_SERIES[feedback], _SPRINGS[feedback]
    spans = {springs[places.index(a) : places.index(b)]: (a, b) for a, b in pairwise(chain)}
    unseen = tuple(name for name in springs if not any(name in names for names in spans))
    # Every difference is on the same design: what one assumes, all do.
    counted = _fitted(lines, np.zeros(len(record.force)))[1]
    if record.deflection is not None:
        fit, _ = _fitted(lines, _channel(record, "deflection"))
        whole = fit.estimate("compliance")
    parts = []
    for names, (a, b) in spans.items():
        fit, _ = _fitted(lines, _channel(record, b) - _channel(record, a))
        parts.append(_part(names, fit, _share(fit.estimate("compliance"), whole)))
    if whole is None:
        return parts, counted, None
    # All spans together, first to last position: what they share between them is then counted once.
    seen = _channel(record, chain[-1]) - _channel(record, chain[0]) if len(chain) > 1 else np.zeros(len(record.force))
    if record.deflection is not None:
        fit, _ = _fitted(lines, _channel(record, "deflection") - seen)
        parts.append(_part(unseen, fit, _share(fit.estimate("compliance"), whole)))
        return parts, counted, whole
    fit, _ = _fitted(lines, seen)
    left = _less(whole, fit.estimate("compliance"))
    parts.append(OnAxisPart(unseen, left, True, _share(left, whole), None))
    return parts, counted, whole


def _less(one: Estimate, other: Estimate) -> Estimate:
    """Difference of two independent compliances (JCGM 100, G.2b)."""
    if not (one.known and other.known):
        return Estimate(one.value - other.value, inf)
    contributions = np.array([[one.standard_uncertainty, other.standard_uncertainty]])
    degrees = np.array([one.degrees_of_freedom, other.degrees_of_freedom])
    freedom = float(effective_degrees_of_freedom(contributions, degrees)[0])
    return Estimate(one.value - other.value, float(np.linalg.norm(contributions)), freedom)


def _channel(record: OnAxisRecord, name: str) -> Array:
    return np.asarray(getattr(record, name), float)


def _lines(record: OnAxisRecord) -> tuple[_Lines, list[str]]:
    """Columns that every difference is fitted by, and what they leave unsaid."""
    force = _channel(record, "force")
    if not len(force) or np.ptp(force) <= 1e-9 * np.abs(force).max():
        raise RankError(
            f"axis {record.axis}: all {len(force)} readings are at one force; what grows with the force cannot be told from "
            f"what does not, measure at two forces at least"
        )
    runs, straight = _runs(record), np.column_stack([force, np.ones(len(force))])
    if record.velocity is None:
        return _Lines(straight, ("compliance", "offset"), runs), []
    direction = _directions(_channel(record, "velocity"), runs)
    if np.ptp(direction) == 0:
        return _Lines(straight, ("compliance", "offset"), runs), [
            f"Axis {record.axis} moves in one direction only: what changes with the direction (backlash, friction) is in "
            f"the offset and cannot be told."
        ]
    lines = _Lines(np.column_stack([straight, direction]), ("compliance", "offset", "reversal"), runs)
    if confounding(merge(*_factors(lines, np.zeros(len(force))))).rank < 3:
        raise RankError(
            f"axis {record.axis}: the force changes exactly as the direction of motion does, so compliance and reversal "
            f"cannot be distinguished; load the axis at two forces in each direction, or leave the velocity out and "
            f"read both as one"
        )
    return lines, []


def _directions(velocity: Array, runs: Mapping[str, NDArray[np.intp]]) -> Array:
    """Sign of the motion; an axis at rest keeps the direction it came from, as its backlash does."""
    direction = np.sign(velocity)
    for rows in runs.values():
        moving = np.where(direction[rows] != 0, np.arange(len(rows)), -1)
        last = np.maximum.accumulate(moving)
        direction[rows] = np.where(last >= 0, direction[rows][last], 0.0)
    return direction


def _runs(record: OnAxisRecord) -> dict[str, NDArray[np.intp]]:
    """Rows of each run, in the order of their first reading."""
    if record.run is None:
        return {"": np.arange(len(record.force))}
    names = np.asarray(record.run)
    return {str(name): np.flatnonzero(names == name) for name in dict.fromkeys(record.run)}


def _factors(lines: _Lines, difference: Array) -> list[Factor]:
    rows = np.column_stack([lines.design, difference])
    return [factor_blocks(lines.labels, [np.asfortranarray(rows[run])]) for run in lines.runs.values()]


def _fitted(lines: _Lines, difference: Array) -> tuple[Solution, Counted]:
    """Straight line over the force, with the uncertainty of its runs if there are enough."""
    return solved_by_run(_factors(lines, difference), lines.labels)


def _part(names: tuple[str, ...], fit: Solution, share: float | None, acts: bool = True) -> OnAxisPart:
    reversal = fit.estimate("reversal") if "reversal" in fit.labels else None
    return OnAxisPart(names, fit.estimate("compliance"), acts, share, reversal)


def _share(compliance: Estimate, whole: Estimate | None) -> float | None:
    return compliance.value / whole.value if whole is not None and whole.value > 0 else None


def _limits(record: OnAxisRecord, feedback: str, parts: Sequence[OnAxisPart], whole: Estimate | None) -> list[str]:
    """What cannot be said of this axis, in sentences."""
    lacking = [
        spoken
        for channel, spoken in (("command", "command"), ("motor", "motor encoder"), ("scale", "linear scale"))
        if channel in _IN_SERIES[feedback] and getattr(record, channel) is None
    ]
    said = [
        f"Axis {record.axis}: {' and '.join(part.names)} cannot be distinguished; it takes the {' and the '.join(lacking)}."
        for part in parts
        if len(part.names) > 1
    ]
    if feedback == "scale":
        seen = any(part.names == (TRANSMISSION,) for part in parts)
        said.append(
            f"The position loop of axis {record.axis} is closed on the scale: its transmission is inside the loop and does "
            f"not move the tool quasi-statically; its compliance "
            f"{'is stated but not counted.' if seen else 'is not seen without motor encoder and scale.'}"
        )
    if whole is None:
        said.append(
            f"Axis {record.axis}: guideway and structure are not seen, because the deflection at the tool was neither "
            f"logged nor given; no shares follow."
        )
    return said


def _by_run(counted: Counted) -> Check:
    return Check("uncertainty of the parts by run", counted.by_run, {"runs": counted.runs, "needed": counted.needed})


def _springs(parts: Sequence[OnAxisPart]) -> Check:
    """Whether every part yields with the force, to within its uncertainty; not tested where none is known."""
    judged = [part for part in parts if part.compliance.known]
    wrong = tuple(part.name for part in judged if part.compliance.interval()[1] < 0)
    return Check("springs in series", not wrong if judged else None, {"negative": wrong}, decisive=bool(wrong))


def _apart(parts: Sequence[OnAxisPart]) -> Check:
    together = tuple(part.name for part in parts if len(part.names) > 1)
    return Check("parts distinguished", not together, {"together": together})
