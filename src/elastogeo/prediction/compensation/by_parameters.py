"""From identified parameters to error tables: what the tool is off along each axis's motion while one axis moves.

A table is the deviation of the tool relative to the workpiece, along the motion of the axis that makes it good, at the
positions through which the tests moved the axis that causes it, all other axes where the tests stood in the middle. It is
linear in the parameters, so its uncertainty and whether the tests support it follow from the design, as for any reading.
What two axes cause together (an angle of one times the travel of another) is in no table of one axis; it stays.

Parameters that belong together (the powers of one error motion, one squareness, one backlash) are a group, and are written
or left out together. A group that the tests do not determine is left out, unless the tests determine its sum with others.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from elastogeo.identification import Identification
from elastogeo.machine import Array, ErrorTable, Joint, Machine, loop_frames, motion_of
from elastogeo.prediction.compensation.parts import ErrorPart, FoundError, zero_within
from elastogeo.prediction.knowledge import Knowledge, knowledge_of
from elastogeo.prediction.virtual import virtual_observations

POINTS = 41
"""Positions of a table."""

PER_PITCH = 12
"""Positions to each turn of a screw, where a cyclic error was asked for."""

MOST_POINTS = 2000
_DEGREE = re.compile(r"[cs]?\d+$")
_NOTHING = 1e-12
"""Of the greatest deviation that a parameter of its expected size makes anywhere: below, it makes none here."""


def found_by_parameters(result: Identification, zero_at: Mapping[str, float] | None = None) -> tuple[FoundError, ...]:
    """The errors that identified parameters amount to, one for each axis and direction that has any.

    Parameters
    ----------
    result : Identification
        Of one test, or of several of one machine.
    zero_at : mapping of str to float, optional [mm or rad]
        By axis, the position at which its errors count as zero; 0 where the tests hold it, else the position nearest to it.

    Raises
    ------
    InputError
        If `zero_at` is outside of where the tests moved the axis.
    """
    knowledge = knowledge_of(result)
    spans = tested_spans(result)
    found: list[FoundError] = []
    for axis, (low, high) in spans.items():
        if high > low:
            zero = zero_within(axis, low, high, (zero_at or {}).get(axis))
            found += _of_axis(knowledge, axis, _positions(knowledge, axis, low, high), zero)
    return tuple(found)


def tested_spans(result: Identification) -> dict[str, tuple[float, float]]:
    """Through which positions the tests moved each axis."""
    commands = np.vstack([run.commands for runs in result.campaign.observations().values() for run in runs])
    axes = result.campaign.machine.axes
    return {axis: (float(commands[:, k].min()), float(commands[:, k].max())) for k, axis in enumerate(axes) if axis != "S"}


def _positions(knowledge: Knowledge, axis: str, low: float, high: float) -> Array:
    joint = knowledge.machine.joints[knowledge.machine.index(axis)]
    cyclic = joint.pitch if any(s.name.startswith("P_") and s.site[1] == axis for s in knowledge.sources) else None
    count = POINTS if cyclic is None else min(max(POINTS, int(PER_PITCH * (high - low) / cyclic) + 1), MOST_POINTS)
    return np.linspace(low, high, count)


def _of_axis(knowledge: Knowledge, axis: str, position: Array, zero: float) -> Iterator[FoundError]:
    for component in _components(knowledge, axis):
        asked = _asked(knowledge, axis, component, position, zero)
        groups = _groups(knowledge, asked)
        if groups:
            yield _found(knowledge, axis, component, position, zero, groups)


def _components(knowledge: Knowledge, axis: str) -> tuple[str, ...]:
    """Displacements along the linear axes there are, and what the axis itself does."""
    linear = (motion_of(joint.name) for joint in knowledge.machine.joints if not joint.is_rotary)
    return tuple(dict.fromkeys([motion_of(axis), *sorted(linear)]))


def _asked(knowledge: Knowledge, axis: str, component: str, position: Array, zero: float) -> Array:
    """What the deviation asks of the parameters, shape (k, 2, p), less what it asks at the zero."""
    k = len(position)
    at_zero = np.append(position, zero)
    rows = np.stack([_rows(knowledge, axis, component, at_zero, sense) for sense in (1.0, -1.0)], axis=1)
    return np.asarray(rows[:k] - rows[k:].mean(axis=1, keepdims=True))


def _rows(knowledge: Knowledge, axis: str, component: str, position: Array, sense: float) -> Array:
    """What the deviation asks of the parameters as one axis comes to positions in a direction, shape (k, p)."""
    moving = knowledge.machine.index(axis)
    commands = np.tile(knowledge.centre, (len(position), 1))
    commands[:, moving] = position
    senses = np.zeros_like(commands)
    senses[:, moving] = sense
    return deviation_rows(knowledge, commands, senses, _moved_by(knowledge.machine, axis, component))


def deviation_rows(knowledge: Knowledge, commands: Array, sense: Array, joint: Joint) -> Array:
    """What the deviation along (or about) the motion of a joint asks of the parameters, shape (k, p).

    Parameters
    ----------
    knowledge : Knowledge
    commands, sense : array, shape (k, n)
        Poses, and from which side each axis came.
    joint : Joint
    """
    direction = np.zeros((len(commands), 6))
    part = slice(3, 6) if joint.is_rotary else slice(0, 3)
    frames = loop_frames(knowledge.machine, commands)
    direction[:, part] = frames.joints[joint.name].location.rotation[:, :, joint.direction]
    virtual = virtual_observations(knowledge.machine, commands, direction, np.zeros((1, 6)))
    return knowledge.rows(replace(virtual, sense=sense))


def _moved_by(machine: Machine, axis: str, component: str) -> Joint:
    """The axis that makes the error good: the one that causes it, or the one that moves along it."""
    names = [axis] if motion_of(axis) == component else []
    names += [joint.name for joint in machine.joints if joint.name != "S" and motion_of(joint.name) == component]
    return machine.joints[machine.index(names[0])]


def _groups(knowledge: Knowledge, asked: Array) -> dict[tuple[str, ...], Array]:
    """By the names of the parameters in it, what each group asks, shape (k, 2, p); those that ask nothing are left out."""
    scaled = np.abs(asked * knowledge.scales).max(axis=(0, 1))
    members: dict[str, list[int]] = {}
    for k, source in enumerate(knowledge.sources):
        if scaled[k] > _NOTHING * scaled.max() > 0 and not source.elastic:
            members.setdefault(_DEGREE.sub("", source.name), []).append(k)
    found = {}
    for chosen in members.values():
        own = np.zeros_like(asked)
        own[:, :, chosen] = asked[:, :, chosen]
        found[tuple(knowledge.sources[k].name for k in chosen)] = own
    return found


def _found(
    knowledge: Knowledge, axis: str, component: str, position: Array, zero: float, groups: dict[tuple[str, ...], Array]
) -> FoundError:
    """The error, of what the tests determine; the rest by name."""
    known = {names: asked for names, asked in groups.items() if _determined(knowledge, asked)}
    others = {names: asked for names, asked in groups.items() if names not in known}
    together = np.sum(list(others.values()), axis=0) if len(others) > 1 else None
    if together is not None and _determined(knowledge, together):
        known[tuple(name for names in others for name in names)] = together
        others = {}
    parts = tuple(ErrorPart(names, *_predicted(knowledge, asked)) for names, asked in known.items())
    whole = np.sum(list(known.values()), axis=0) if known else np.zeros_like(next(iter(groups.values())))
    table = ErrorTable(axis, component, position, *_predicted(knowledge, whole))
    return FoundError(table, parts, zero, tuple(name for names in others for name in names))


def _determined(knowledge: Knowledge, asked: Array) -> bool:
    return bool(knowledge.predict(asked.reshape(-1, asked.shape[2])).supported.all())


def _predicted(knowledge: Knowledge, asked: Array) -> tuple[Array, Array]:
    """Values and expanded uncertainties, shape (k, 2)."""
    found = knowledge.predict(asked.reshape(-1, asked.shape[2]))
    return found.value.reshape(-1, 2), found.expanded.reshape(-1, 2)
