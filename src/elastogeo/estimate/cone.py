"""Estimates that a physical law holds in a cone: symmetric positive semidefinite blocks, seen through what a test can see.

The free estimate s of r combinations `T c` of parameters c has the covariance V. Where blocks of c are symmetric positive
semidefinite matrices, T c lies in a convex cone K. The constrained estimate is the point of K nearest to s in the metric of
V; the distance squared tells whether the data contradict the law (`p_value_bound`).

It is solved on the polar side: the part of s outside K is the nearest point of the polar cone, which has r variables at
most however many parameters there are, and is closed. K itself need not be: if an off-diagonal is seen and its diagonal is
not, the diagonal may be as large as it likes and the off-diagonal is free. Such *unseen* directions of each block are found
first and taken out of it (facial reduction: Borwein and Wolkowicz, 1981), so that what is left is well posed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate.factor import Array
from elastogeo.estimate.interior_point import nearest_polar_point

Block = NDArray[np.int_]

INSIDE = 1e-8
"""An estimate nearer to the cone than this, in squared standard uncertainties, is inside."""

ROUNDING = 1e-9
"""An estimate outside by less than this share of its size is inside: rounding error of its readings or of the solver."""

_LARGE = 1e5
"""Size, in standard uncertainties, to which a larger estimate (from readings without noise) is scaled down."""

_DEPENDENT = 1e-9
"""Unit columns nearer than this to the span of others depend on them."""

_UNSEEN = 1e-7
"""A semidefinite direction of unit trace with a smaller effect on unit columns is not seen."""

_RANK = 1e-4
"""Eigenvalues of an unseen direction smaller than this, relative to its greatest, are zero."""


@dataclass(frozen=True, slots=True)
class _Block:
    """One semidefinite block: where its entries are among the parameters, and what scales its components.

    Attributes
    ----------
    index : array of int, shape (k, k)
    scale : array, shape (k,)
        Makes the effect of every diagonal of unit size, whatever the units.
    effect : array, shape (r, k, k)
        Of the scaled symmetric block on the whitened combinations.
    face : array, shape (k, n)
        Orthonormal basis of the components, scaled, on which the block must be semidefinite.
    """

    index: Block
    scale: Array
    effect: Array
    face: Array


@dataclass(frozen=True, slots=True)
class PsdCone:
    """The cone of the combinations that semidefinite blocks allow, in the metric of a covariance.

    Attributes
    ----------
    root : array, shape (r, r)
        Lower Cholesky factor of the covariance: `root^-1 s` has unit covariance.
    effect : array, shape (r, p)
        `root^-1 T`.
    basis : array, shape (r, m)
        Orthonormal; the whitened directions that the law restricts.
    free : array, shape (p, f)
        Changes of the parameters that it does not.
    blocks : tuple of _Block
        On their faces.
    restrictions : tuple of array, shape (m, n, n)
        Effect of each block's face on the restricted directions: `sum_k a_k A_k` is negative semidefinite for every outward
        direction a.
    inner : array, shape (m,)
        An outward direction for which it is negative definite in every block.
    """

    root: Array
    effect: Array
    basis: Array
    free: Array
    blocks: tuple[_Block, ...]
    restrictions: tuple[Array, ...]
    inner: Array

    @property
    def dimension(self) -> int:
        """In how many directions an estimate can leave the cone."""
        return int(self.basis.shape[1])

    @property
    def directions(self) -> Array:
        """Combinations of the estimates that the law restricts, shape (r, m): uncorrelated, each of variance 1."""
        return np.asarray(solve_triangular(self.root, self.basis, lower=True, trans="T"))

    @property
    def restricted(self) -> NDArray[np.bool_]:
        """Which of the estimates the law restricts, by themselves or together with others, shape (r,)."""
        deviations = np.linalg.norm(self.root, axis=1)
        return np.asarray(np.abs(self.directions).max(axis=1, initial=0.0) * deviations > _UNSEEN)

    @property
    def one_sided(self) -> bool:
        """Whether the law restricts more than by equations: a sign, a determinant."""
        return any(block.face.shape[1] for block in self.blocks)


@dataclass(frozen=True, slots=True)
class Projection:
    """The point of a cone nearest to an estimate.

    Attributes
    ----------
    values : array, shape (r,)
        The constrained estimate.
    parameters : array, shape (p,)
        A set of parameters that gives it: **one of many**. Every block is symmetric, and semidefinite in what the
        combinations see of it; what they do not see can be chosen so that the whole block is, as nearly as one likes.
    distance_squared : float
        From the free estimate, in the metric of its covariance.
    outward : array, shape (r,)
        Coefficients of the combination that is out of bounds: at most zero for every set of parameters that obeys the law,
        and `sqrt(distance_squared)` standard uncertainties above zero for the free estimate. Zero inside.
    inside : bool
        Whether the free estimate obeys the law itself; `values` are then its own.
    depth : float
        How deep the values lie in the cone, at least, in standard uncertainties: no combination of unit variance that the
        law keeps from being positive is above minus this. Zero on the boundary; infinite where equations alone restrict.
    shallow : array, shape (r,)
        Coefficients of the combination to which that depth belongs, of unit variance, with either sign.
    """

    values: Array
    parameters: Array
    distance_squared: float
    outward: Array
    inside: bool
    depth: float
    shallow: Array


def psd_cone(covariance: Array, combinations: Array, blocks: Sequence[Block]) -> PsdCone:
    """The cone of combinations `T c` whose parameters form symmetric positive semidefinite blocks.

    Parameters
    ----------
    covariance : array, shape (r, r)
        Of the estimated combinations.
    combinations : array, shape (r, p)
        T.
    blocks : sequence of array of int, shape (k, k)
        Index among the p parameters of every entry, -1 where there is none. An entry and its mirror may be two parameters,
        which are then equal, or one. A parameter whose mirror is missing is free, and so is one of no block. A missing
        diagonal restricts nothing.

    Returns
    -------
    PsdCone

    Raises
    ------
    InputError
        If the covariance is not positive definite, shapes do not fit, or a parameter stands in two places.
    """
    root = _root(covariance)
    if combinations.ndim != 2 or len(combinations) != len(root):
        raise InputError(f"{len(root)} estimates need combinations of {len(root)} rows, got the shape {combinations.shape}")
    effect = solve_triangular(root, combinations, lower=True)
    own = _check_blocks(blocks, combinations.shape[1])
    faced = [_block(block, effect) for block in blocks]
    unbound = np.delete(np.eye(combinations.shape[1]), own, axis=1)
    while True:
        free = np.column_stack([unbound, *(_unrestricted(block, len(unbound)) for block in faced)])
        basis = _complement(_unit_effects(effect, free)[0])
        restrictions = [_restriction(block, basis) for block in faced]
        unseen, inner = _unseen(restrictions, basis.shape[1])
        if unseen is None:
            return PsdCone(root, effect, basis, free, tuple(faced), tuple(restrictions), inner)
        faced = [_without(block, direction) for block, direction in zip(faced, unseen, strict=True)]


def project(cone: PsdCone, values: Array) -> Projection:
    """The point of the cone nearest to an estimate: a semidefinite programme in `cone.dimension` variables.

    Raises
    ------
    InputError
        If the values are not r finite numbers.
    UnsupportedError
        If rounding stops the search.
    """
    if values.shape != (len(cone.root),) or not np.isfinite(values).all():
        raise InputError(f"the estimate must be {len(cone.root)} finite numbers, got {values}")
    white = solve_triangular(cone.root, values, lower=True)
    norm = float(np.linalg.norm(white))
    size = max(1.0, norm / _LARGE)  # a cone has no size of its own
    found = nearest_polar_point(cone.basis.T @ white / size, cone.restrictions, cone.inner)
    distance = size * 0.5 * (found.least + found.most)
    inside = (size * found.least) ** 2 <= max(INSIDE, (ROUNDING * norm) ** 2)
    outward = np.zeros(len(white)) if inside else cone.basis @ found.point * size
    nearest = white - outward
    parameters = np.zeros(cone.effect.shape[1])
    for block, multiplier in zip(cone.blocks, found.multipliers, strict=True):
        parameters += size * _assembled(block, block.face @ multiplier @ block.face.T, len(parameters))
    if cone.free.shape[1]:
        columns, factors = _unit_effects(cone.effect, cone.free)
        rest, *_ = np.linalg.lstsq(columns, nearest - cone.effect @ parameters, rcond=_DEPENDENT)
        parameters += cone.free @ (factors * rest)
    depth, shallow = _depth(cone, found.multipliers)
    return Projection(
        values=values.copy() if inside else cone.root @ nearest,
        parameters=parameters,
        distance_squared=0.0 if inside else distance**2,
        outward=solve_triangular(cone.root, outward, lower=True, trans="T"),
        inside=inside,
        depth=size * depth,
        shallow=solve_triangular(cone.root, cone.basis @ shallow, lower=True, trans="T"),
    )


def is_never_negative(cone: PsdCone, weights: Array) -> bool:
    """Whether a weighted sum of the combinations is zero or more for every set of parameters that obeys the law."""
    coordinates = cone.basis.T @ (cone.root.T @ weights)
    size = float(np.linalg.norm(cone.root.T @ weights))
    if not size or np.linalg.norm(coordinates) < size * (1 - _UNSEEN):
        return False  # it changes along a direction that the law leaves free
    matrices = [np.tensordot(coordinates, matrices, 1) / size for matrices in cone.restrictions]
    return all(np.linalg.eigvalsh(matrix).min(initial=0.0) >= -_UNSEEN for matrix in matrices)


def _root(covariance: Array) -> Array:
    """Lower Cholesky factor, taken of the correlations so that no unit decides."""
    if covariance.ndim != 2 or covariance.shape[0] != covariance.shape[1] or not np.isfinite(covariance).all():
        raise InputError(f"the covariance must be a square matrix of finite numbers, got the shape {covariance.shape}")
    variance = np.diag(covariance)
    if not (variance > 0).all():
        raise InputError("the covariance must be positive definite; a variance in it is not positive")
    deviation = np.sqrt(variance)
    try:
        root = np.linalg.cholesky(covariance / np.outer(deviation, deviation))
    except np.linalg.LinAlgError as error:
        raise InputError("the covariance must be positive definite; some combination has no variance") from error
    return np.asarray(deviation[:, np.newaxis] * root)


def _check_blocks(blocks: Sequence[Block], parameters: int) -> list[int]:
    """The parameters that the blocks restrict: diagonals, and off-diagonals whose mirror is there."""
    own: list[int] = []
    for block in blocks:
        if block.ndim != 2 or block.shape[0] != block.shape[1]:
            raise InputError(f"a block must be square, got the shape {block.shape}")
        if block.size and (block.min() < -1 or block.max() >= parameters):
            raise InputError(f"a block names the parameters {block.min()} to {block.max()}; there are {parameters}")
        for i in range(len(block)):
            for j in range(i + 1):
                if block[i, j] >= 0 and block[j, i] >= 0:
                    own += sorted({int(block[i, j]), int(block[j, i])})
    twice = sorted({k for k in own if own.count(k) > 1})
    if twice:
        raise InputError(f"parameter {twice[0]} stands in two places of the blocks")
    return own


def _block(index: Block, effect: Array) -> _Block:
    """A block with its components scaled; those whose diagonal is missing or without effect restrict nothing."""
    size = len(index)
    matrices = np.zeros((len(effect), size, size))
    for i in range(size):
        if index[i, i] >= 0:
            matrices[:, i, i] = effect[:, index[i, i]]
        for j in range(i):
            if index[i, j] >= 0 and index[j, i] >= 0:
                both = sum(effect[:, k] for k in {index[i, j], index[j, i]})
                matrices[:, i, j] = matrices[:, j, i] = both / 2
    norms = np.array([np.linalg.norm(matrices[:, i, i]) for i in range(size)])
    seen = norms > 0
    scale = np.divide(1.0, np.sqrt(norms), out=np.ones(size), where=seen)
    return _Block(index, scale, matrices * scale * scale[:, np.newaxis], np.eye(size)[:, seen])


def _assembled(block: _Block, matrix: Array, parameters: int) -> Array:
    """Parameters, shape (p,), of a scaled symmetric matrix in the place of a block."""
    c = np.zeros(parameters)
    unscaled = matrix * block.scale * block.scale[:, np.newaxis]
    restricted = (block.index >= 0) & (block.index.T >= 0)
    c[block.index[restricted]] = unscaled[restricted]
    return c


def _unrestricted(block: _Block, parameters: int) -> Array:
    """Changes of the parameters, shape (p, f), that leave a block as it is on its face."""
    size = len(block.index)
    off_face = _complement(block.face)
    pairs = [np.outer(w, e) for w in off_face.T for e in np.eye(size)]
    return np.array([_assembled(block, pair + pair.T, parameters) for pair in pairs]).reshape(-1, parameters).T


def _restriction(block: _Block, basis: Array) -> Array:
    """Effect, shape (m, n, n), of a block's face on the restricted directions."""
    return np.asarray(np.einsum("rm,rij,ia,jb->mab", basis, block.effect, block.face, block.face, optimize=True))


def _depth(cone: PsdCone, multipliers: Sequence[Array]) -> tuple[float, Array]:
    """How deep a point of the cone lies in it, at least, and the restricted direction of that, shape (m,).

    The point is `A(Z)`. For every outward direction a of unit length S(a) is semidefinite, so that
    `-a . A(Z) = tr(Z^1/2 S(a) Z^1/2)` is at least the norm of that matrix: at least the least singular value of the linear
    map from a to it. Directions that equations alone restrict have no S and are left out. For signs it is the depth itself.
    """
    filled = [(block, Z) for block, Z in zip(cone.restrictions, multipliers, strict=True) if len(Z)]
    if not filled:
        return inf, np.zeros(cone.dimension)
    U, sizes, _ = np.linalg.svd(np.hstack([block.reshape(cone.dimension, -1) for block, _ in filled]), full_matrices=False)
    signed = U[:, sizes > _DEPENDENT * sizes.max()]
    seen = []
    for block, Z in filled:
        values, vectors = np.linalg.eigh(Z)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        seen.append((root.T @ block @ root).reshape(cone.dimension, -1))
    directions, depths, _ = np.linalg.svd(signed.T @ np.hstack(seen), full_matrices=False)
    return float(depths[-1]), np.asarray(signed @ directions[:, -1])


def _unit_effects(effect: Array, changes: Array) -> tuple[Array, Array]:
    """Effects of changes of the parameters as unit columns, and the factors that make them so; zero if rounding error."""
    columns = effect @ changes
    norms = np.linalg.norm(columns, axis=0)
    seen = norms > _DEPENDENT * np.linalg.norm(np.abs(effect) @ np.abs(changes), axis=0)
    factors = np.divide(1.0, norms, out=np.zeros_like(norms), where=seen)
    return columns * factors, factors


def _complement(columns: Array) -> Array:
    """Orthonormal basis of all that is orthogonal to some columns of unit length, or zero."""
    U, values, _ = np.linalg.svd(columns)
    return np.asarray(U[:, int(np.sum(values > _DEPENDENT)) :])


def _without(block: _Block, direction: Array) -> _Block:
    """The block on what is left of its face without a semidefinite direction, given on the face."""
    values, vectors = np.linalg.eigh(direction)
    return _Block(block.index, block.scale, block.effect, block.face @ vectors[:, values <= _RANK])


def _unseen(restrictions: Sequence[Array], dimension: int) -> tuple[list[Array] | None, Array]:
    """A semidefinite direction of the blocks, of greatest rank, that changes nothing in the restricted directions, if any.

    It is what makes the distance of the trace from the cone of `(effect, trace)` zero. If there is none, the second is a
    point inside the polar cone, shape (m,).
    """
    sizes = [matrices.shape[1] for matrices in restrictions]
    if not any(sizes):
        return None, np.zeros(dimension)
    with_trace = [np.concatenate([A, np.eye(n)[np.newaxis]]) for A, n in zip(restrictions, sizes, strict=True)]
    trace = np.append(np.zeros(dimension), 1.0)
    found = nearest_polar_point(trace, with_trace, -trace, gap=_UNSEEN**2, enough=_UNSEEN)
    if found.least >= _UNSEEN:
        return None, found.inner[:dimension]
    if found.most > sqrt(_UNSEEN):
        raise UnsupportedError("what the test sees of the joints was not settled: rounding error stopped the search")
    greatest = max(float(np.linalg.eigvalsh(direction).max(initial=0.0)) for direction in found.multipliers)
    return [direction / greatest for direction in found.multipliers], np.zeros(dimension)
