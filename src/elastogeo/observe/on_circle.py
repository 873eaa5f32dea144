"""What every set-up has whose readings go around a circle."""

from __future__ import annotations

from elastogeo.observe.circle import Circle
from elastogeo.observe.setup import Setup


class OnCircle(Setup):
    """A set-up whose readings count along the angle of a circle.

    Attributes
    ----------
    circle : Circle
        Path and centre.
    """

    __slots__ = ()

    circle: Circle

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have: those of a bar."""
        return ("angle", "radial")

    @property
    def pose_quantity(self) -> str:
        """The angle in the plane of the circle."""
        return "angle"

    @property
    def nominal_radius(self) -> float:
        """That of the circle."""
        return self.circle.radius

    @property
    def own_to_run(self) -> tuple[str, ...]:
        """The offsets of the circle's centre."""
        return ("E_[XYZ]t0",)
