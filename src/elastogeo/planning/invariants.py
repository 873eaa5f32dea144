"""The compliances that a motion carries along without changing them: the invariant tensors of a group of motions.

A compliance tensor `C` (6 x 6: twist for a wrench) that sits behind a motion `g` acts outside as `Ad C Ad^T`, where `Ad`
(6 x 6) carries twists. It is invariant under the motion of an axis if that is `C` wherever the axis stands, which is to
say `G C + C G^T = 0` with `G` the generator of `Ad`. The invariant tensors are the null space of `G (x) I + I (x) G`: 20
dimensions for a linear axis, 12 for a rotary one, fewer for several axes together, all 36 for no motion.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.machine import Array, Frame
from elastogeo.prediction import TYPICAL_LEVER

INVARIANT = 1e-9
"""Relative tolerance of the null space, with lengths counted in the typical lever: 0.3 um beside an axis is beside it."""


def generator(frame: Frame, direction: int, rotary: bool) -> Array:
    """Generator of the twist map of an axis's own motion, shape (6, 6), in the foundation [1, mm].

    Parameters
    ----------
    frame : Frame
        Location frame of the axis, at one pose.
    direction : int
        Coordinate axis of that frame along or about which it moves: 0, 1, 2.
    rotary : bool
    """
    unit, origin = frame.rotation[0, :, direction], frame.origin[0]
    rotation = unit if rotary else np.zeros(3)
    G = np.zeros((6, 6))
    G[:3, :3] = G[3:, 3:] = _cross(rotation)
    G[:3, 3:] = _cross(np.cross(origin, unit) if rotary else unit)
    return G


def twist_map(frame: Frame) -> Array:
    """`Ad`, shape (6, 6): carries a twist in a frame, at one pose, to the foundation [1, mm]."""
    R = frame.rotation[0]
    Ad = np.zeros((6, 6))
    Ad[:3, :3] = Ad[3:, 3:] = R
    Ad[:3, 3:] = _cross(frame.origin[0]) @ R
    return Ad


def invariants(generators: Sequence[Array], reciprocal: bool = False) -> Array:
    """A basis of the tensors that every motion leaves unchanged, shape (k, 6, 6) [mm/N, ...], in the generators' frame.

    The basis is the reduced echelon form, entry by entry, each beginning with one: an invariant of one entry stands alone.

    Parameters
    ----------
    generators : sequence of array, shape (6, 6) [1, mm]
        Of the twist map of each motion; none for no motion.
    reciprocal : bool
        Only symmetric tensors.
    """
    scale = np.array([1.0] * 3 + [1.0 / TYPICAL_LEVER] * 3)
    tensors = _symmetric() if reciprocal else np.eye(36).reshape(36, 6, 6)
    rows = [np.zeros((1, len(tensors)))]
    for G in generators:
        scaled = G * scale / scale[:, np.newaxis]
        size = np.abs(scaled).max()
        changed = (scaled @ tensors + tensors @ scaled.T) / size
        rows.append(changed.reshape(len(tensors), 36).T)
    _, values, Vt = np.linalg.svd(np.vstack(rows))
    rank = int((values > INVARIANT).sum())
    found = echelon(Vt[rank:] @ tensors.reshape(len(tensors), 36))
    found = found.reshape(-1, 6, 6) * scale[:, np.newaxis] * scale
    first = found.reshape(-1, 36)[np.arange(len(found)), (found != 0).reshape(-1, 36).argmax(axis=1)]
    return np.asarray(found / first[:, np.newaxis, np.newaxis])


def echelon(rows: Array) -> Array:
    """Reduced row echelon form of independent rows, shape (k, n): what is rounding error is zero."""
    rows = rows.copy()
    done = 0
    for column in range(rows.shape[1]):
        if done == len(rows):
            break
        pivot = done + int(np.abs(rows[done:, column]).argmax())
        if abs(rows[pivot, column]) < INVARIANT:
            continue
        rows[[done, pivot]] = rows[[pivot, done]]
        rows[done] /= rows[done, column]
        others = np.arange(len(rows)) != done
        rows[others] -= np.outer(rows[others, column], rows[done])
        done += 1
    rows[np.abs(rows) < INVARIANT] = 0.0
    return rows


def _symmetric() -> Array:
    """The 21 symmetric tensors with entries of one, shape (21, 6, 6)."""
    return np.array(
        [
            np.eye(6)[:, [d]] * np.eye(6)[f] + (d != f) * np.eye(6)[:, [f]] * np.eye(6)[d]
            for d in range(6)
            for f in range(d, 6)
        ]
    )


def _cross(v: Array) -> Array:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
