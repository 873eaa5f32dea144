"""The point of a polar cone nearest to another, by a primal-dual method: few variables, semidefinite blocks of six at most.

The polar cone holds all x for which `S(x) = -sum_k x_k A_k` is semidefinite in every block. At the nearest one semidefinite
multipliers Z have `x + A(Z) = w`, with `A(Z)_k = tr(A_k Z)` summed over the blocks, and `S Z = 0`. Newton's steps follow
`S Z = mu I` as mu falls, in the scaling of Nesterov and Todd with Mehrotra's correction (Toh, Tutuncu and Todd,
doi:10.1080/10556789908805762); each is a least-squares problem, so that no condition number is squared.

Every step brackets the answer, whatever rounding did: `A(Z)` is a point of the cone itself, so the distance of w from it is
at most `|w - A(Z)|`; x is in the polar cone, so it is at least `w . x / |x|`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr

from elastogeo.errors import UnsupportedError
from elastogeo.estimate.factor import Array

GAP = 1e-9
"""Width of the bracket, relative to the distance or to 1, at which a search ends."""

_WORST_GAP = 1e-3
"""Width of the bracket with which the search may end where rounding stops it."""

_STEPS = 100
"""Never reached: a search takes about twenty."""

_SHORT_OF_BOUNDARY = 0.9
"""Share of the way to the boundary of the blocks that a step may go."""


@dataclass(frozen=True, slots=True)
class PolarPoint:
    """The nearest point of a polar cone.

    Attributes
    ----------
    point : array, shape (m,)
    multipliers : tuple of array, shape (n, n)
        Z of each block, semidefinite: `A(Z)` is `w - point`.
    inner : array, shape (m,)
        Beside the point, and inside the polar cone.
    least : float
        The distance of w from the cone is at least this; it is at most the length of the point.
    """

    point: Array
    multipliers: tuple[Array, ...]
    inner: Array
    least: float

    @property
    def most(self) -> float:
        """The distance of w from the cone is at most this."""
        return float(np.linalg.norm(self.point))

    @property
    def gap(self) -> float:
        """Width of the bracket, relative to the distance or to 1."""
        return (self.most - self.least) / max(1.0, self.most)


def nearest_polar_point(
    w: Array, blocks: Sequence[Array], inner: Array, *, gap: float = GAP, enough: float = np.inf
) -> PolarPoint:
    """The point of the polar cone nearest to w.

    Parameters
    ----------
    w : array, shape (m,)
    blocks : sequence of array, shape (m, n, n)
        Symmetric A_k, k = 1 to m, of each block.
    inner : array, shape (m,)
        A point at which all `-sum_k x_k A_k` are positive definite.
    gap : float
        Width of the bracket, relative to the distance or to 1, at which the search ends.
    enough : float
        The search ends as soon as the distance is known to be at least this.

    Raises
    ------
    UnsupportedError
        If rounding stops the search before the distance is known to three digits.
    """
    filled = [block for block in blocks if block.shape[1]]
    size = float(np.linalg.norm(w))
    if not filled or not size:
        return PolarPoint(w.copy(), tuple(np.zeros(block.shape[1:]) for block in blocks), w.copy(), size)
    x = inner * (size / float(np.linalg.norm(inner)))
    inverse = [np.linalg.inv(_slack(block, x)) for block in filled]
    scale = size * sum(map(len, inverse)) / sum(float(np.trace(part)) for part in inverse)
    Z: list[Array] = [np.asarray(scale * part) for part in inverse]
    best = _bracket(w, filled, x, Z)
    for _ in range(_STEPS):
        if best.gap <= gap or best.least >= enough:
            break
        try:
            x, Z = _step(w, filled, x, Z)
        except np.linalg.LinAlgError:
            break
        found = _bracket(w, filled, x, Z)
        best = min(best, found, key=lambda each: each.gap)
    if best.gap > _WORST_GAP and best.least < enough:
        raise UnsupportedError(
            f"the nearest physical estimate was not found: rounding error stopped the search with its distance between "
            f"{best.least:.3g} and {best.most:.3g} standard uncertainties"
        )
    of_filled = iter(best.multipliers)
    multipliers = tuple(next(of_filled) if block.shape[1] else np.zeros((0, 0)) for block in blocks)
    return PolarPoint(best.point, multipliers, best.inner, best.least)


def _slack(block: Array, x: Array) -> Array:
    """`S(x)` of one block."""
    return np.asarray(-(x @ block.reshape(len(x), -1)).reshape(block.shape[1:]))


def _effect(blocks: Sequence[Array], Z: Sequence[Array]) -> Array:
    """`A(Z)`."""
    return np.asarray(sum(block.reshape(len(block), -1) @ part.ravel() for block, part in zip(blocks, Z, strict=True)))


def _bracket(w: Array, blocks: Sequence[Array], x: Array, Z: Sequence[Array]) -> PolarPoint:
    return PolarPoint(w - _effect(blocks, Z), tuple(Z), x, max(0.0, float(w @ x) / float(np.linalg.norm(x))))


def _step(w: Array, blocks: Sequence[Array], x: Array, Z: Sequence[Array]) -> tuple[Array, list[Array]]:
    """One step, predicted and corrected, towards a smaller mu."""
    scaling = [_scaling(_slack(block, x), part) for block, part in zip(blocks, Z, strict=True)]
    slopes = [R.T @ block @ R for (R, _), block in zip(scaling, blocks, strict=True)]
    rows = np.vstack([np.eye(len(w)), *(slope.reshape(len(w), -1).T for slope in slopes)])
    order = np.argsort(-np.abs(rows).max(axis=1))  # long rows first, columns pivoted: short rows keep their digits
    Q = np.empty_like(rows)
    Q[order] = qr(rows[order], mode="economic", pivoting=True)[0]
    missing = x + _effect(blocks, Z) - w
    diagonals = [d for _, d in scaling]
    ends = np.cumsum([d.size**2 for d in diagonals])[:-1]
    mu = sum(float(d @ d) for d in diagonals) / sum(map(len, diagonals))

    def towards(wanted: Sequence[Array]) -> tuple[Array, list[Array], list[Array], float]:
        """Change of x, of S and Z in the scaling, and how far it may go."""
        right = np.concatenate([missing, *(part.ravel() for part in wanted)])
        left = right - Q @ (
            Q.T @ right
        )  # residuals of the least squares: nothing cancels, as it would in slopes times change
        left -= Q @ (Q.T @ left)
        dZ = [part.reshape(each.shape) for part, each in zip(np.split(left[len(w) :], ends), wanted, strict=True)]
        dS = [each - part for each, part in zip(wanted, dZ, strict=True)]
        reach = min(_reach(d, part) for each in (dS, dZ) for d, part in zip(diagonals, each, strict=True))
        return left[: len(w)] - missing, dS, dZ, min(1.0, _SHORT_OF_BOUNDARY * reach)

    _, dS, dZ, length = towards([-np.diag(d) for d in diagonals])
    centring = mu * (1.0 - length) ** 3
    wanted = [_corrected(d, centring, s, z) for d, s, z in zip(diagonals, dS, dZ, strict=True)]
    change, _, dZ, length = towards(wanted)
    return x + length * change, [part + length * R @ dz @ R.T for part, dz, (R, _) in zip(Z, dZ, scaling, strict=True)]


def _scaling(S: Array, Z: Array) -> tuple[Array, Array]:
    """R and d with `R^T S R = R^-1 Z R^-T = diag(d)` (Nesterov and Todd)."""
    root = np.linalg.cholesky(Z)
    U, d, _ = np.linalg.svd(root.T @ np.linalg.cholesky(S))
    return root @ U / np.sqrt(d), d


def _corrected(d: Array, mu: float, dS: Array, dZ: Array) -> Array:
    """What `dS + dZ` is to be for `S Z = mu I` to second order."""
    product = dS @ dZ
    return np.asarray((2 * np.diag(mu - d**2) - product - product.T) / np.add.outer(d, d))


def _reach(d: Array, change: Array) -> float:
    """Greatest step for which `diag(d)` and the step times a change stays semidefinite."""
    lowest = float(np.linalg.eigvalsh(change / np.sqrt(np.outer(d, d))).min())
    return -1.0 / lowest if lowest < 0 else np.inf
