"""One run of a test: what was recorded, and what was the same for every reading."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from elastogeo.equality import ByValue
from elastogeo.machine import Array, Feed, Force, Length, Pressure, Temperature


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Run(ByValue):
    """One run: what was recorded, and what was the same for every reading.

    Attributes
    ----------
    name : str
    columns : mapping of str to array, shape (m,)
        What the instrument recorded, by quantity, in the units of the house: `angle` [rad], `radial` [mm].
    force : float or None [N]
        Force level, if it was given as such.
    pressure : float or None [bar]
        Pressure level, if the force follows from it.
    engagement : float or None [mm]
        Commanded engagement of a roller in a ball; zero or none where it only circles around it.
    feed : float or None [mm/s]
        Speed along the path, if it is not that of the set-up.
    machine_temperature, instrument_temperature : float or None [degC]
        Of this run, where the set-up refers lengths to 20 °C and they are not those of the set-up.
    sense : int
        +1 counter-clockwise, -1 clockwise.
    repeat : int
        Counts the runs of one level, from 1.
    notes : tuple of str
        What was done to its recording before it became columns: sentences for the reader of the result.
    file : str
        The file it was read from, as the test names it; empty if it was read from none.
    sha256 : str
        Of that file's bytes, in hexadecimal digits.
    simulated : str
        What the file says of the simulation that made it; empty if it was measured.
    truth : mapping of str to float
        True parameters by name, in their own units, of a simulated run that says them; all others are zero.
    """

    name: str
    columns: Mapping[str, Array]
    force: Force | None = None
    pressure: Pressure | None = None
    engagement: Length | None = None
    feed: Feed | None = None
    machine_temperature: Temperature | None = None
    instrument_temperature: Temperature | None = None
    sense: int = 1
    repeat: int = 1
    notes: tuple[str, ...] = ()
    file: str = ""
    sha256: str = ""
    simulated: str = ""
    truth: Mapping[str, float] = field(default_factory=dict)

    def __repr__(self) -> str:
        readings = max((len(column) for column in self.columns.values()), default=0)
        return f"<Run {self.name!r}: {readings} readings of {', '.join(self.columns)}>"
