"""Springs in series: the machine, the set-up of the test, the rig (Eqs. 6.1 to 6.5, 6.16).

One force runs through all of them, so their deflections add, and so do their compliances (Eqs. 6.1 to 6.3). The encoders
see the whole engagement, what is left when the set-up's deflection is subtracted is the machine's (6.5), and a rig of known
compliance adds to it (6.16).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from elastogeo.errors import InputError
from elastogeo.estimate import coverage_factor, effective_degrees_of_freedom
from elastogeo.machine import Array, Forces, LengthPerForce, Lengths, LengthsPerForce


@dataclass(frozen=True, slots=True)
class SetupCompliance:
    """Compliance of the set-up, ball and roller bearing in series: one constant, or a table (Tables 6.5, 6.6).

    Give `constant`, or `compliance` with one of `engagement` and `force`. Between its points the table is read along
    straight lines. A table of one point is a constant.

    Attributes
    ----------
    constant : float or None [mm/N]
    compliance : tuple of float [mm/N]
        At each point of the table.
    engagement : tuple of float [mm]
        Engagement of the whole loop at each point, rising.
    force : tuple of float [N]
        Or the force at each point, rising.
    standard_uncertainty : float or None [mm/N]
        Of the constant, or of each value of the table; None if it is not known.
    """

    constant: LengthPerForce | None = None
    compliance: LengthsPerForce = ()
    engagement: Lengths = ()
    force: Forces = ()
    standard_uncertainty: LengthPerForce | None = None

    def __post_init__(self) -> None:
        """Refuse what is neither a constant nor a table."""
        if (self.constant is None) == (not self.compliance):
            raise InputError("the compliance of the set-up is one constant or the values of a table; give one of the two")
        values = (self.constant,) if self.constant is not None else self.compliance
        if not all(np.isfinite(value) and value >= 0 for value in values):
            raise InputError(f"a compliance of the set-up is {min(values):g} mm/N; each must be finite and not negative")
        if self.standard_uncertainty is not None and not (
            np.isfinite(self.standard_uncertainty) and self.standard_uncertainty >= 0
        ):
            raise InputError(f"the uncertainty of the set-up is {self.standard_uncertainty:g} mm/N; it cannot be negative")
        self._check_points()

    def _check_points(self) -> None:
        if self.constant is not None:
            if self.engagement or self.force:
                raise InputError("a constant compliance of the set-up goes with no engagement and no force; leave them out")
            return
        if len(self.compliance) == 1 and not self.points:
            return
        if bool(self.engagement) == bool(self.force):
            raise InputError("the table of the set-up's compliance goes over engagement or over force; give one of the two")
        if len(self.points) != len(self.compliance):
            raise InputError(
                f"the table of the set-up has {len(self.compliance)} compliances at {len(self.points)} points; "
                f"each point needs one"
            )
        if not (np.isfinite(self.points).all() and (np.diff(self.points) > 0).all()):
            raise InputError(f"the points of the set-up's table must rise, they are {_listed(self.points)}")

    @property
    def over(self) -> str:
        """What the table goes over, `engagement` or `force`; empty for a constant."""
        return "" if self.constant is not None or len(self.compliance) == 1 else "engagement" if self.engagement else "force"

    @property
    def points(self) -> tuple[float, ...]:
        """Points of the table [mm or N]."""
        return self.engagement or self.force


def setup_compliance(setup: SetupCompliance, engagement: ArrayLike, force: ArrayLike) -> Array:
    """Compliance of the set-up at each reading, shape (m,) [mm/N].

    Parameters
    ----------
    setup : SetupCompliance
    engagement : array, shape (m,) [mm]
    force : array, shape (m,) [N]

    Raises
    ------
    InputError
        If a reading lies outside the table, which says nothing there, or is no finite number.
    """
    engagement, force = np.broadcast_arrays(np.asarray(engagement, float), np.asarray(force, float))
    if not setup.over:
        return np.full(force.shape, setup.compliance[0] if setup.constant is None else setup.constant)
    at = engagement if setup.over == "engagement" else force
    if not np.isfinite(at).all():
        raise InputError(f"the {setup.over} of {int((~np.isfinite(at)).sum())} readings is NaN or infinite; leave them out")
    # A commanded engagement of 0.04 mm read as 0.04000000000000001 lies in the table.
    slack = 1e-9 * abs(setup.points[-1])
    outside = ~((at >= setup.points[0] - slack) & (at <= setup.points[-1] + slack))
    if outside.any():
        unit = "mm" if setup.over == "engagement" else "N"
        raise InputError(
            f"{int(outside.sum())} readings have the {setup.over} {_span(at[outside])} {unit}, outside the table of the "
            f"set-up's compliance ({setup.points[0]:g} to {setup.points[-1]:g} {unit}); extend the indicator test, or "
            f"leave these readings out"
        )
    return np.asarray(np.interp(at, setup.points, setup.compliance))


def with_rig(machine: ArrayLike, rig: ArrayLike) -> Array:
    """Predicted compliance with a compliant rig in the loop, `C_VM + C_r`, shape (m,) [mm/N] (Eq. 6.16)."""
    return np.asarray(np.asarray(machine, float) + np.asarray(rig, float))


@dataclass(frozen=True, slots=True)
class RigCheck:
    """Measured against predicted: do they agree within their uncertainty?

    Attributes
    ----------
    difference : array, shape (m,)
        Measured less predicted.
    standard_uncertainty, degrees_of_freedom, expanded_uncertainty : array, shape (m,)
        Of the difference.
    normalised_error : array, shape (m,)
        E_n: the difference over its expanded uncertainty.
    agrees : array of bool, shape (m,)
        Whether |E_n| is 1 at most.
    coverage : float
    """

    difference: Array
    standard_uncertainty: Array
    degrees_of_freedom: Array
    expanded_uncertainty: Array
    normalised_error: Array
    agrees: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]
    coverage: float


def rig_check(
    measured: ArrayLike,
    u_measured: ArrayLike,
    predicted: ArrayLike,
    u_predicted: ArrayLike,
    *,
    freedom: tuple[ArrayLike, ArrayLike] = (np.inf, np.inf),
    u_shared: ArrayLike = 0.0,
    coverage: float = 0.95,
) -> RigCheck:
    """Whether a measured compliance agrees with the predicted one, reading by reading (section 6.6.3).

    The normalised error is that of proficiency tests (E_n of ISO 13528 and ISO/IEC 17043, definitions as in NIST's
    Dataplot): difference over `sqrt(U^2 + U_ref^2)`. There both sides are expanded by one factor; here the factor is
    Student's at the effective degrees of freedom of the difference (JCGM 100, G.4), which comes to the same when they are
    many. An agreement says no more than that the uncertainties are not too small: **with large ones everything agrees.**
    Of m checks at 95 %, one in twenty fails though all is well.

    Parameters
    ----------
    measured, predicted : array, shape (m,) [mm/N]
        Or any one unit.
    u_measured, u_predicted : array, shape (m,)
        Standard uncertainties of what the two do not share.
    freedom : tuple of 2 array, shape (m,)
        Degrees of freedom of the two.
    u_shared : array, shape (m,)
        Standard uncertainty that influences common to both leave in their difference. A force known to a part s alike with
        and without the rig leaves `s (measured - C_VM)`; the set-up's compliance, subtracted from both, leaves nothing.
    coverage : float

    Raises
    ------
    InputError
        If a value is no finite number, an uncertainty is negative or all are zero.
    """
    given = (measured, u_measured, predicted, u_predicted, *freedom, u_shared)
    arrays = np.broadcast_arrays(*(np.atleast_1d(np.asarray(value, float)) for value in given))
    one, u_one, other, u_other, v_one, v_other, common = arrays
    if not all(np.isfinite(array).all() for array in (one, u_one, other, u_other, common)):
        raise InputError("a compliance to compare, or its uncertainty, is NaN or infinite; each must be a finite number")
    if min(u_one.min(), u_other.min(), common.min()) < 0 or not (v_one > 0).all() or not (v_other > 0).all():
        raise InputError("an uncertainty to compare is negative, or has no degrees of freedom; neither can be judged by")
    contributions = np.stack([u_one, u_other, common], axis=-1)
    uncertainty = np.linalg.norm(contributions, axis=-1)
    if not uncertainty.all():
        raise InputError("measured and predicted compliance have no uncertainty; without one there is no agreement to judge")
    degrees = np.stack([v_one, v_other, np.full(one.shape, np.inf)], axis=-1)
    effective = effective_degrees_of_freedom(contributions.reshape(-1, 3), degrees.reshape(-1, 3)).reshape(one.shape)
    expanded = coverage_factor(effective, coverage) * uncertainty
    error = (one - other) / expanded
    return RigCheck(one - other, uncertainty, effective, expanded, error, np.abs(error) <= 1.0, coverage)


def _span(values: Array) -> str:
    low, high = float(values.min()), float(values.max())
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def _listed(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:g}" for value in values)
