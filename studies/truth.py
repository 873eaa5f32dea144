"""What a simulated machine and set-up really are: parameters by the names of the conventions, and faults of every place.

A truth is data; `ball_bar` makes readings of it. Sizes are those at the greatest force of the layout.
"""

from __future__ import annotations

from dataclasses import dataclass

Named = tuple[tuple[str, float], ...]

TABLE_5_5: Named = (
    ("C_XXX", 6.19e-5),
    ("C_XYX", 7.98e-7),
    ("C_YYY", 4.61e-5),
    ("C_CXY", -2.69e-8),
    ("C_CYY", -1.66e-8),
    ("C_CCY", 1.10e-9),
    ("E_XX1", -1.3e-4),
    ("E_YX2", 4.34e-7),
    ("E_XY2", -7.26e-7),
    ("E_YY1", -9.86e-5),
    ("E_C(0Y)X", 1.15e-6),
    ("E_Xt0", 0.003891),
    ("E_Yt0", -0.00062),
)
"""Tables 5.5 and 5.6 of the thesis, its C_CCY made positive: a joint cannot gain energy from a moment."""

BALL_BAR: Named = (
    ("E_XX1", -2.0e-5),
    ("E_YY1", 3.0e-5),
    ("E_C(0Y)X", 4.0e-5),
    ("E_YX2", 3.0e-8),
    ("E_XY2", -2.0e-8),
    ("E_Xt0", 0.004),
    ("E_Yt0", -0.003),
    ("B_XX", 0.003),
    ("B_YY", -0.002),
)
"""An ordinary machining centre under an ordinary ball bar."""

FOUR_LOBE = -13.5e-3
"""The form [mm] times cos^2 sin^2 that the measurements of the thesis hold at every force."""


@dataclass(frozen=True)
class Truth:
    """A machine, its set-up and its force, as they really are.

    Attributes
    ----------
    parameters : tuple of (name, value) [mm, rad, N and their quotients]
        `C_dfj`, `E_djn`, `E_d(0i)j`, `E_dt0`, `E_dw0`, `E_R0`; `B_XX` (what X falls short by in all when it reverses) and
        `T_X1` (servo lag [s]), both along the axis's own command.
    softening : float
        What every compliance gains from no force to the greatest, as a share: -0.2 for a fall of 20 %.
    contact : float
        Share of each on-axis deflection that a contact law carries at the greatest force.
    contact_exponent : float
    four_lobe : float [mm]
        Times cos^2 sin^2 of the angle, at every force.
    harmonics : tuple of (order, amplitude [mm], phase [rad])
        In every run, whatever its force.
    force_scale : float
        The true force is the stated one times 1 + this.
    force_scatter : tuple of float
        By which relative amount the force of each run is off beside that; empty for none.
    force_bend : float
        The true force is larger than the stated one by this share near no force, and equal at the greatest.
    setup_compliance : float [mm/N]
        Of the post under the workpiece ball, the same in every horizontal direction.
    off_level : tuple of (force [N], amplitude [mm], order)
        A level whose readings hold a harmonic that no other level has.
    outliers : tuple of (share, size [mm])
        Share of the readings that are off, half of them up, half down: drawn with the noise.
    """

    parameters: Named = TABLE_5_5
    softening: float = 0.0
    contact: float = 0.0
    contact_exponent: float = 2.0 / 3.0
    four_lobe: float = 0.0
    harmonics: tuple[tuple[int, float, float], ...] = ()
    force_scale: float = 0.0
    force_scatter: tuple[float, ...] = ()
    force_bend: float = 0.0
    setup_compliance: float = 0.0
    off_level: tuple[tuple[float, float, int], ...] = ()
    outliers: tuple[float, float] = (0.0, 0.0)


def with_values(base: Named, **values: float) -> Named:
    """The parameters with some of them changed or added; a name with brackets is given to `dict` by its user."""
    return tuple({**dict(base), **values}.items())
