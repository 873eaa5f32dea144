"""Rebuild the six traces of the thesis's real test from its printed tables: `python reconstruct.py FOLDER`.

Every local estimate is a linear function of the traces of two adjacent force levels, of which the model's columns see eight
shapes each. So 65 printed numbers of chapter 5 and 24 of chapter 4 determine 46 of the 48 unknowns; the two directions that
are left alternate in sign from level to level, and the smoothest course over the levels fixes them (least squared steps).
docs/real-data.md says what comes out, and why it can be believed.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from tables import (
    COMPLIANCES,
    FORCES,
    GEOMETRY,
    PRESSURES,
    SET_UP_DEFLECTION,
    TABLE_4_7,
    TABLE_5_7,
    TABLE_5_8,
    half_unit,
)

Array = np.ndarray
RADIUS = 150.0
READINGS = 360
"""Of a trace that a local estimate was made of."""

WRITTEN = 120
"""Of a trace that is written: the shapes have no order above the fourth."""

ANGLE = 2 * np.pi * np.arange(READINGS) / READINGS
SHAPES = ("c2", "cs", "s2", "c2s", "cs2", "c2s2", "c", "s")

_SHAPE_OF = {
    **dict(zip(COMPLIANCES, ("c2", "cs", "s2", "c2s", "cs2", "c2s2"), strict=True)),
    **dict(zip(GEOMETRY, ("c2", "c2s", "cs2", "s2", "cs", "c", "s"), strict=True)),
}
_POWER_OF_RADIUS = dict.fromkeys((*COMPLIANCES, *GEOMETRY), 0) | {
    "C_CXY": 1,
    "C_CYY": 1,
    "C_CCY": 2,
    "E_XX1": 1,
    "E_YX2": 2,
    "E_XY2": 2,
    "E_YY1": 1,
    "E_C(0Y)X": 1,
}
ASSUMED = 2e-4
"""Standard uncertainty [mm] of each of the two assumed directions, a unit vector over all 48 numbers: twice by how much
least squared second differences, or differences over the force, would place them elsewhere."""

UNKNOWN = 1e-9
"""Share of the greatest singular value below which a direction of the traces is in no printed number."""


@dataclass(frozen=True)
class Reconstruction:
    """The traces that the tables hold.

    Attributes
    ----------
    traces : array, shape (6, 8) [mm]
        Of each level, in shapes.
    factor : array, shape (46, 6, 8) [mm]
        Of the covariance from the rounding of the tables, one standard deviation each; a printed figure counts as
        rectangular within half a unit of its last digit.
    assumed : array, shape (2, 6, 8)
        Unit directions that no printed number holds.
    misfit : array, shape (89,)
        Of each printed number, in half units of its last digit.
    """

    traces: Array
    factor: Array
    assumed: Array
    misfit: Array


def shapes(angle: Array) -> Array:
    """What a trace is made of, shape (m, 8)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([c * c, c * s, s * s, c * c * s, c * s * s, c * c * s * s, c, s])


def columns(names: tuple[str, ...], force: float) -> Array:
    """The columns of parameters on a circle at one force, in shapes, shape (8, p): Eq. 4.13 and Table 5.1 by hand."""
    design = np.zeros((len(SHAPES), len(names)))
    for k, name in enumerate(names):
        design[SHAPES.index(_SHAPE_OF[name]), k] = RADIUS ** _POWER_OF_RADIUS[name] * (force if name in COMPLIANCES else 1.0)
    return design


def local_operator(names: tuple[str, ...], one: float, other: float) -> Array:
    """What a local estimate makes of two traces, shape (p, 16): the pseudo-inverse over all readings of both."""
    root = np.linalg.cholesky(shapes(ANGLE).T @ shapes(ANGLE)).T
    stacked = np.vstack([root @ columns(names, force) for force in (one, other)])
    norms = np.linalg.norm(stacked, axis=0)
    return np.linalg.pinv(stacked / norms) / norms[:, None] @ np.kron(np.eye(2), root)


def equations(chapter_4: bool = True) -> tuple[Array, Array, Array]:
    """The printed numbers as equations of the traces: matrix, shape (89, 48), right side, half units.

    Without chapter 4 only the 65 of Tables 5.7 and 5.8.
    """
    rows, right, units = [], [], []
    for k in range(len(FORCES) - 1):
        rows.append(_placed(local_operator(COMPLIANCES + GEOMETRY, FORCES[k], FORCES[k + 1]), k))
        printed = TABLE_5_7[k] + TABLE_5_8[k]
        right.append([float(figure) for figure in printed])
        units.append([half_unit(figure) for figure in printed])
    round_ = np.array([1.0, 0, 1, 0, 0, 0, 0, 0])
    bent = SET_UP_DEFLECTION * (np.array(PRESSURES) - PRESSURES[0])
    for k, printed in enumerate(TABLE_4_7 if chapter_4 else (), 1):
        operator = local_operator(COMPLIANCES, FORCES[k] - FORCES[0], FORCES[k + 1] - FORCES[0])
        row = _placed(operator, k)
        row[:, : len(SHAPES)] -= operator[:, : len(SHAPES)] + operator[:, len(SHAPES) :]
        rows.append(row)
        set_up = operator @ np.concatenate([bent[k] * round_, bent[k + 1] * round_])
        right.append([float(figure) - part for figure, part in zip(printed, set_up, strict=True)])
        units.append([half_unit(figure) for figure in printed])
    return np.vstack(rows), np.concatenate(right), np.concatenate(units)


def _placed(operator: Array, k: int) -> Array:
    """An operator on the traces of levels k and k + 1, on those of all."""
    wide = np.zeros((len(operator), len(FORCES) * len(SHAPES)))
    wide[:, k * len(SHAPES) : (k + 2) * len(SHAPES)] = operator
    return wide


def reconstruct(chapter_4: bool = True) -> Reconstruction:
    """The traces by least squares, each equation in half units of its last digit."""
    matrix, right, units = equations(chapter_4)
    u, sizes, vt = np.linalg.svd(matrix / units[:, None], full_matrices=False)
    known = sizes > UNKNOWN * sizes[0]
    inverse = vt[known].T / sizes[known]
    traces = inverse @ (u[:, known].T @ (right / units))
    left = vt[~known]
    steady = [shape not in ("c2", "s2") for shape in SHAPES]  # these two grow with the force in any machine
    step = np.kron(np.diff(np.eye(len(FORCES)), axis=0), np.eye(len(SHAPES))[steady])
    traces = traces - left.T @ np.linalg.lstsq(step @ left.T, step @ traces, rcond=None)[0]
    return Reconstruction(
        traces=traces.reshape(len(FORCES), -1),
        factor=inverse.T.reshape(-1, len(FORCES), len(SHAPES)) / np.sqrt(3),
        assumed=left.reshape(-1, len(FORCES), len(SHAPES)),
        misfit=(matrix @ traces - right) / units,
    )


def main(folder: Path) -> None:
    """Write one run file a level, for chapter 5 and, with the set-up's deflection put back, for chapter 4.

    The columns `u_...` hold what is uncertain, one standard deviation each, alike in all runs.
    """
    found = reconstruct()
    angle = 2 * np.pi * np.arange(WRITTEN) / WRITTEN
    shape = shapes(angle)
    uncertain = {f"u_rounding_{k:02d}": part for k, part in enumerate(found.factor, 1)}
    uncertain |= {f"u_assumed_course_{k}": ASSUMED * part for k, part in enumerate(found.assumed, 1)}
    for level, force in enumerate(FORCES):
        rest = {f"{name}_um": 1e3 * shape @ part[level] for name, part in uncertain.items()}
        radial = 1e3 * shape @ found.traces[level]
        _write(folder / f"runs/{force:03d}N.csv", {"angle_deg": np.degrees(angle), "radial_um": radial, **rest})
        raw = radial + 1e3 * SET_UP_DEFLECTION * PRESSURES[level]
        _write(folder / f"chapter-4/runs/{force:03d}N.csv", {"angle_deg": np.degrees(angle), "radial_um": raw})


def _write(path: Path, columns: dict[str, Array]) -> None:
    rows = "\n".join(",".join(f"{value:.6g}" for value in row) for row in zip(*columns.values(), strict=True))
    head = f"# rows: {WRITTEN}\n# reconstructed: from published tables, not measured by us and not simulated\n"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{head}{','.join(columns)}\n{rows}\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
