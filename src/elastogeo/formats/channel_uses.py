"""What a test or drive file says of the channels of a log (`[[channels]]`) and of their common clock (`[clock]`)."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from elastogeo.errors import InputError
from elastogeo.formats.text.units import UNITS, spellings
from elastogeo.machine import Current, Force, Time, Torque

_RATED = ("current", "torque", "force")


@dataclass(frozen=True, slots=True)
class ChannelUse:
    """What one channel of a log stands for: an entry of the table `channels` of a test file.

    Attributes
    ----------
    quantity : str
        `current_x`, `position_x`, `velocity_x`, `force_x`, ...; `time` for the channel that is the clock of a file whose
        channels have none.
    channel : str
        Its name in the file; empty for the channel whose name says this quantity.
    unit : str
        Of its values, where the file says none: `A`, `mm`, `N m`, `%`, ...; `1` for a number without a unit.
    delay : float [s]
        By which its samples are late against those of the others; it is subtracted from its clock.
    rated_current, rated_torque, rated_force : float or None [A, N mm, N]
        What 100 % of the channel are, where its unit is `%`; the one that fits the quantity. Without it the channel stays in
        percent, and so does what is identified from it.
    """

    quantity: str
    channel: str = ""
    unit: str = ""
    delay: Time = 0.0
    rated_current: Current | None = None
    rated_torque: Torque | None = None
    rated_force: Force | None = None

    def __post_init__(self) -> None:
        """Refuse a quantity without a name, a unit that is none, a delay that is no number."""
        if not self.quantity or self.quantity != self.quantity.strip():
            raise InputError(f"the quantity {self.quantity!r} is no name; write for example current_x")
        if self.unit not in ("", "1") and self.unit not in UNITS:
            raise InputError(f"the unit {self.unit[:40]!r} of {self.quantity} is not known: use {spellings()}")
        if not isfinite(self.delay):
            raise InputError(f"the delay of {self.quantity} is {self.delay}; write a number of seconds")
        kind = self.quantity.partition("_")[0]
        for name in _RATED:
            value = getattr(self, f"rated_{name}")
            if value is not None and name != kind:
                raise InputError(f"{self.quantity} has a rated {name}; give rated_{kind}, with its unit, or leave it out")
            if value is not None and not (isfinite(value) and value > 0):
                raise InputError(f"rated_{name} of {self.quantity} is {value}; it must be above zero")

    @property
    def rated(self) -> float | None:
        """What 100 % are, in the internal unit of the quantity."""
        return next((v for name in _RATED if (v := getattr(self, f"rated_{name}")) is not None), None)


@dataclass(frozen=True, slots=True)
class Clock:
    """The clock that the channels of a log are put on: the table `clock` of a test file.

    Attributes
    ----------
    sample_time : float or None [s]
        Of the common clock, and of a file that keeps none; by default that of the slowest channel chosen.
    longest_gap : float or None [s]
        The longest gap that is bridged by a straight line; by default three sample times.
    """

    sample_time: Time | None = None
    longest_gap: Time | None = None

    def __post_init__(self) -> None:
        """Refuse times that are not above zero."""
        for name in ("sample_time", "longest_gap"):
            value = getattr(self, name)
            if value is not None and not (isfinite(value) and value > 0):
                raise InputError(f"{name} is {value} s; it must be above zero")
