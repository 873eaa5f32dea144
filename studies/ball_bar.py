"""The readings of a ball bar, loaded or not, on any machine of linear and held rotary axes: exact, by finite transforms.

The bar pushes its balls apart along itself. Each joint gives way by its compliance times the force and moment that its
carriage bears; what its errors and deflections move is computed with transforms of any size.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from studies.chain import ALONG, LETTERS, Array, Chain, point
from studies.truth import Truth

PLANES = {"XY": (0, 1), "YZ": (1, 2), "ZX": (2, 0)}
COMPLIANCE = re.compile(r"C_([XYZABC])([XYZABC])([XYZUVWABCS])")
ERROR_MOTION = re.compile(r"E_([XYZABC])([XYZUVWABCS])([1-9])")
LOCATION = re.compile(r"E_([XYZABC])\(0[XYZUVWABCS]?\)([XYZUVWABCS])")
SETUP = re.compile(r"E_([XYZ])([tw])0")
AXIS_LAG = re.compile(r"B_([XYZUVW])\1|T_([XYZUVW])1")


@dataclass(frozen=True)
class Circles:
    """Runs of one circle: the tool ball goes around the workpiece ball.

    Attributes
    ----------
    chain : Chain
    forces : tuple of float [N]
        As stated, one a run.
    senses : tuple of int
        1 counter-clockwise, -1 clockwise.
    readings : int
        A turn, evenly spaced, half a step away from the reversals of the axes.
    radius : float [mm]
    plane : str
    feed : float [mm/s]
    held : tuple of (axis, command [mm, rad])
        At the centre; an axis not named is at zero.
    """

    chain: Chain
    forces: tuple[float, ...]
    senses: tuple[int, ...]
    readings: int = 72
    radius: float = 150.0
    plane: str = "XY"
    feed: float = 2000 / 60
    held: tuple[tuple[str, float], ...] = ()

    @cached_property
    def angle(self) -> Array:
        """Of every reading, shape (runs, m) [rad]: from 0 up, or from a turn down."""
        up = (np.arange(self.readings) + 0.5) * 2 * np.pi / self.readings
        return np.array([up if sense > 0 else up[::-1] for sense in self.senses])

    @cached_property
    def direction(self) -> Array:
        """From the workpiece ball to the tool ball, shape (runs m, 3)."""
        first, second = PLANES[self.plane]
        along = np.zeros((self.angle.size, 3))
        along[:, first], along[:, second] = np.cos(self.angle.ravel()), np.sin(self.angle.ravel())
        return along

    @cached_property
    def tangent(self) -> Array:
        """Where the tool ball moves, shape (runs m, 3)."""
        first, second = PLANES[self.plane]
        along = np.zeros((self.angle.size, 3))
        along[:, first], along[:, second] = -np.sin(self.angle.ravel()), np.cos(self.angle.ravel())
        return along * np.repeat(self.senses, self.readings)[:, np.newaxis]

    @cached_property
    def linear(self) -> str:
        """The linear axes."""
        return "".join(axis for axis in self.chain.axes if axis in ALONG)

    @cached_property
    def ball(self) -> Array:
        """The workpiece ball in the frame of the table, shape (3,): where the tool is at the centre."""
        frames = self.chain.frames({axis: np.array([command]) for axis, command in self.held})
        table, tool = frames["w"][0], point(frames["t"], np.array(self.chain.tool))[0]
        return np.asarray(table[:3, :3].T @ (tool - table[:3, 3]))

    @cached_property
    def steps(self) -> Array:
        """Motion of the tool ball relative to the workpiece ball per command of each linear axis, shape (3, n)."""
        held = dict(self.held)

        def between(axis: str) -> Array:
            commands = {name: np.array([value]) for name, value in held.items()}
            commands[axis] = np.array([held.get(axis, 0.0) + 1.0])
            frames = self.chain.frames(commands)
            return np.asarray((point(frames["t"], np.array(self.chain.tool)) - point(frames["w"], self.ball))[0])

        return np.column_stack([between(axis) for axis in self.linear])

    def commands(self, truth: Truth | None = None) -> dict[str, Array]:
        """Of every axis, shape (runs m,); with a truth, where the axis really goes: it falls short and lags."""
        back = np.linalg.pinv(self.steps)
        moved, rate = self.radius * self.direction @ back.T, self.feed * self.tangent @ back.T
        commands = {axis: np.full(len(moved), command) for axis, command in self.held}
        for k, axis in enumerate(self.linear):
            commands[axis] = commands.get(axis, 0.0) + moved[:, k]
        for name, value in () if truth is None else truth.parameters:
            if match := AXIS_LAG.fullmatch(name):
                axis = match[1] or match[2]
                speed = rate[:, self.linear.index(axis)]
                commands[axis] = commands[axis] - (value * speed if match[2] else value / 2 * np.sign(speed))
        return commands

    def loads(self, force: Array) -> dict[str, Array]:
        """Force and moment that each carriage bears along and about its own axes, shape (runs m, 6) [N, N mm]."""
        frames = self.chain.frames(self.commands())
        tool = point(frames["t"], np.array(self.chain.tool))
        borne = {}
        for axis in self.chain.axes:
            frame = frames[axis]
            pushed = self.chain.side(axis) * force[:, np.newaxis] * self.direction
            moment = np.cross(tool - frame[:, :3, 3], pushed)
            turned = np.broadcast_to(frame[:, :3, :3], (len(force), 3, 3))
            borne[axis] = np.hstack([np.einsum("mji,mj->mi", turned, v) for v in (pushed, moment)])
        return borne

    def true_readings(self, truth: Truth) -> Array:
        """Change of the bar's length without any noise, shape (runs, m) [mm]."""
        stated = np.repeat(self.forces, self.readings)
        most = max(map(abs, self.forces)) or 1.0
        of_run = 1.0 + np.repeat(truth.force_scatter or (0.0,) * len(self.forces), self.readings)
        force = stated * of_run * (1.0 + truth.force_scale) * (1.0 + truth.force_bend * (1.0 - np.abs(stated) / most))
        before, after = self.twists(truth, force, most)
        frames = self.chain.frames(self.commands(truth), before, after)
        shifts = {end: np.zeros(3) for end in "tw"}
        for name, value in truth.parameters:
            if match := SETUP.fullmatch(name):
                shifts[match[2]][LETTERS.index(match[1])] += value
        tool = point(frames["t"], np.array(self.chain.tool) + shifts["t"])
        apart = np.linalg.norm(tool - point(frames["w"], self.ball + shifts["w"]), axis=1)
        reading = apart - self.radius + dict(truth.parameters).get("E_R0", 0.0)
        reading = reading + truth.setup_compliance * force * (1.0 - self.direction[:, 2] ** 2)
        return np.asarray(reading.reshape(self.angle.shape) + self.forms(truth))

    def twists(self, truth: Truth, force: Array, most: float) -> tuple[dict[str, Array], dict[str, Array]]:
        """What errors and deflections move at each axis, before its motion and behind it, shape (runs m, 6)."""
        loads, held, commands = self.loads(force), dict(self.held), self.commands()
        before: dict[str, Array] = {}
        after: dict[str, Array] = {}
        size = np.zeros((len(force), 6))
        for name, value in truth.parameters:
            if match := COMPLIANCE.fullmatch(name):
                d, f, axis = match.groups()
                load = loads[axis][:, LETTERS.index(f)]
                carried = truth.contact if d == f == axis else 0.0
                given = value * load * (1.0 + truth.softening * np.abs(force) / most) * (1.0 - carried)
                if carried:
                    given = given + carried * value * most * np.sign(load) * (np.abs(load) / most) ** truth.contact_exponent
                after.setdefault(axis, size.copy())[:, LETTERS.index(d)] += given
            elif match := ERROR_MOTION.fullmatch(name):
                d, axis, degree = match.groups()
                moved = (commands[axis] - held.get(axis, 0.0)) ** int(degree)
                after.setdefault(axis, size.copy())[:, LETTERS.index(d)] += value * moved
            elif match := LOCATION.fullmatch(name):
                before.setdefault(match[2], size.copy())[:, LETTERS.index(match[1])] += value
            elif not (SETUP.fullmatch(name) or AXIS_LAG.fullmatch(name) or name == "E_R0"):
                raise ValueError(f"this test maker knows no parameter {name!r}; add it to `studies/ball_bar.py`")
        return before, after

    def forms(self, truth: Truth) -> Array:
        """What is in the readings and in no joint, shape (runs, m) [mm]."""
        angle = self.angle
        form = truth.four_lobe * np.cos(angle) ** 2 * np.sin(angle) ** 2
        for order, amplitude, phase in truth.harmonics:
            form = form + amplitude * np.cos(order * angle + phase)
        for level, amplitude, order in truth.off_level:
            at = np.isclose(self.forces, level)[:, np.newaxis]
            form = form + at * amplitude * np.cos(order * angle)
        return np.asarray(form)
