'''The register of instruments: found and registered by themselves, in every file of this room and its wings.

To add one, write one file in a wing, with a set-up class that registers itself. Nothing else changes: test files may name
it, and the contract suite in `tests/contract` tests it. A complete one, `dial_gauge.py`::

    """A dial gauge on the spindle, turned by hand about a loaded mandrel: it reads along its own direction."""

    from dataclasses import dataclass, field, replace

    import numpy as np

    from elastogeo.machine import AxisCommands, workpiece_ball
    from elastogeo.observe import Observations, Setup, check_observations, instrument


    @instrument("dial-gauge")
    @dataclass(frozen=True)
    class DialGauge(Setup):
        pull: tuple[float, float, float] = (0.0, 0.0, -1.0)
        pose: AxisCommands = field(default_factory=dict)

        quantities = ("angle", "displacement")
        pose_quantity = "angle"

        def observe(self, machine, run):
            angle = run.columns["angle"]
            centre = np.array([self.pose.get(axis, 0.0) for axis in machine.axes])
            still = np.zeros((len(angle), len(centre)))
            none = np.zeros((len(angle), 4))
            observations = Observations(
                run=run.name,
                force=run.force,
                pose=angle,
                commands=still + centre,
                velocity=still,
                acceleration=still,
                centre=centre,
                direction=np.column_stack([np.cos(angle), np.sin(angle), none]),
                wrench=run.force * np.tile([*self.pull, 0.0, 0.0, 0.0], (len(angle), 1)),
                reading=run.columns["displacement"],
                correction=np.zeros(len(angle)),
                tool=np.array(machine.tool),
                workpiece=workpiece_ball(machine, self.pose),
            )
            return check_observations(observations)

        def simulated(self, machine, run, respond, imperfection, random):
            angle = run.columns["angle"]
            blank = self.observe(machine, replace(run, columns={"angle": angle, "displacement": np.zeros(len(angle))}))
            read = imperfection.noisy(respond(blank), random)
            return replace(run, columns={"angle": angle, "displacement": read})

What else a set-up may say (its default question, its facts for a report, its template for `elastogeo new`, observations
that take all runs at once) is in `setup.Setup`, with defaults.
'''

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from elastogeo.discovery import import_all
from elastogeo.errors import InputError
from elastogeo.observe.setup import Setup

_REGISTER: dict[str, type[Setup]] = {}
S = TypeVar("S", bound=type)


def instrument(name: str) -> Callable[[S], S]:
    """Register a set-up class under the name that test files use."""

    def register(setup: S) -> S:
        _REGISTER[name] = setup
        return setup

    return register


def instruments() -> dict[str, type[Setup]]:
    """All instruments by name; every file of this room and its wings is looked at."""
    import_all(__name__.rpartition(".")[0])
    return dict(sorted(_REGISTER.items()))


def instrument_of(setup: Setup) -> str:
    """The name of a set-up's instrument; that of its class, if it is not registered."""
    return next((name for name, known in instruments().items() if known is type(setup)), type(setup).__name__)


def instrument_named(name: str) -> type[Setup]:
    """The set-up class of an instrument.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    known = instruments()
    if name not in known:
        raise InputError(f"there is no instrument {name!r}; there are: {', '.join(known)}")
    return known[name]
