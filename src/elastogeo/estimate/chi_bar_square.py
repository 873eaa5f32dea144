"""How probable a distance from a cone is (Perlman, doi:10.1214/aoms/1177697723; Silvapulle and Sen, Constrained Statistical
Inference, 2005, chapter 3)."""

from __future__ import annotations

from math import inf

import numpy as np
from scipy.special import chdtrc, fdtrc


def p_value_bound(
    distance_squared: float, dimension: float, degrees_of_freedom: float = inf, *, one_sided: bool = True
) -> float:
    """Upper bound of the probability of such a distance from the cone or a greater one, whatever parameters obey the law.

    The least favourable of them is the apex of the cone, the least favourable cone a half-line short of a space: half
    chi-square of m degrees of freedom, half of m - 1 (Perlman 1969). For m = 1, a sign, it is exact.

    Parameters
    ----------
    distance_squared : float
    dimension : float
        m: `PsdCone.dimension`, or fewer where noise of unequal size counts as noise in fewer directions (Box).
    degrees_of_freedom : float
        nu, of the one variance by which the covariance was scaled; infinite if the covariance is known. With finite nu, i
        times Fisher's F of (i, nu) replaces chi-square of i. **Not for a covariance that is estimated as a whole.**
    one_sided : bool
        `PsdCone.one_sided`; a law of equations only has the whole of chi-square of m.

    Returns
    -------
    float
        1 for a distance of zero.
    """
    if distance_squared <= 0 or dimension == 0:
        return 1.0
    tail = _tail(distance_squared, dimension, degrees_of_freedom)
    return 0.5 * (tail + _tail(distance_squared, dimension - 1, degrees_of_freedom)) if one_sided else tail


def _tail(square: float, i: float, nu: float) -> float:
    """Probability that chi-square of i degrees of freedom, over a variance known to nu, exceeds a positive number."""
    if i <= 0:
        return 0.0
    return float(chdtrc(i, square) if np.isinf(nu) else fdtrc(i, nu, square / i))
