"""What a control is told, and what is left of the errors after it: frozen numbers only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import UnsupportedError
from elastogeo.formats import write_whole
from elastogeo.identification import Check
from elastogeo.machine import Array, ErrorTable, Program
from elastogeo.observe import Campaign
from elastogeo.prediction.compensation.in_volume import InVolume
from elastogeo.prediction.compensation.parts import FoundError
from elastogeo.prediction.paths import PathPrediction
from elastogeo.result import Result


@dataclass(frozen=True, slots=True)
class LeftOut:
    """What is not compensated, and why.

    Attributes
    ----------
    names : tuple of str
        Of parameters.
    table : str
        Of the table that it belongs to: `E_XX`; `path` of a component of the deviation along a path.
    reason : str
        `uncertainty` (it is not greater than its own), `no interval` (nothing shows its uncertainty), `not determined` (the
        tests do not show it by itself), `control` (the control has no table for it), `not asked` (no parameter that was
        asked for moves it).
    size, doubt : float [mm or rad]
        Root mean square of the part and of its expanded uncertainty; NaN where there is none.
    why : str
        What the control says of it.
    """

    names: tuple[str, ...]
    table: str
    reason: str
    size: float = float("nan")
    doubt: float = float("nan")
    why: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class CompensatedError(ByValue):
    """An error before and after.

    Attributes
    ----------
    found : FoundError
    written : ErrorTable
        What the control compensates, read back from its own files: with their points, rounding and sides.
    """

    found: FoundError
    written: ErrorTable

    @property
    def error(self) -> ErrorTable:
        """Before, with its uncertainty."""
        return self.found.table

    @property
    def residual(self) -> ErrorTable:
        """What is expected after, at the same positions, with its uncertainty.

        What was found less what the control compensates. It is as uncertain as what was found: where the file says what was
        found, nothing is left but that.
        """
        before = self.error
        left = before.value - self.written.at(before.position)
        return ErrorTable(before.axis, before.component, before.position, left, before.uncertainty)

    @property
    def correction(self) -> Array:
        """By how much the control moves the axis otherwise than commanded, shape (k, 2), at the same positions."""
        return -self.written.at(self.error.position)

    @property
    def before(self) -> tuple[float, float]:
        """Greatest deviation [mm or rad] without sign, and its expanded uncertainty."""
        return _greatest(self.error)

    @property
    def after(self) -> tuple[float, float]:
        """As `before`, of what is expected after."""
        return _greatest(self.residual)

    @property
    def bound(self) -> float:
        """What no deviation after exceeds [mm or rad], each by itself at 95 %: the farthest end of the intervals."""
        left = self.residual
        return float(np.max(np.abs(left.value) + left.uncertainty))

    @property
    def by_interpolation(self) -> float:
        """Greatest part of what is left [mm or rad] that comes of the points and the rounding of the file.

        What a control with one curve leaves of a reversal is not counted.
        """
        chosen = self.found.certain()
        if chosen is None:
            return 0.0
        apart = chosen.value - self.written.at(chosen.position)
        return float(np.abs(apart.mean(axis=1) if self.written.one_sided else apart).max())


def _greatest(table: ErrorTable) -> tuple[float, float]:
    where = np.unravel_index(int(np.abs(table.value).argmax()), table.value.shape)
    return float(abs(table.value[where])), float(table.uncertainty[where])


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class PathCompensation(Result):
    """A program with its points moved, and what is expected of the deviation along it.

    Attributes
    ----------
    campaign : Campaign
        The tests that the deviation was predicted from.
    program : Program
        With its points moved, of lines.
    before : PathPrediction
        Along the path as it was, of m points.
    commands : array, shape (m, n) [mm, rad]
        That the new program makes at these points.
    shift : array, shape (m, 3) [mm]
        By how much it commands the tool elsewhere, along the axes of the workpiece.
    value : array, shape (m, 4) [mm]
        Deviation from the path as it was meant, along x, y, z and the normal, that is expected after; NaN where the tests do
        not support it.
    expanded : array, shape (m, 4) [mm]
        Its expanded uncertainty, 95 %.
    components : tuple of str
        Of `x`, `y`, `z`: those that are compensated.
    left_out : tuple of LeftOut
    tolerance : float [mm]
    verdict : tuple of Check
    """

    campaign: Campaign
    program: Program
    before: PathPrediction
    commands: Array
    shift: Array
    value: Array
    expanded: Array
    components: tuple[str, ...]
    left_out: tuple[LeftOut, ...]
    tolerance: float
    verdict: tuple[Check, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Compensation(Result):
    """What a control is told, and what is left after it.

    Attributes
    ----------
    campaign : Campaign
        The tests that the errors were found from.
    control : str
        Its name, as of `elastogeo.formats.compensation_formats`.
    title : str
        What its files are, in words.
    settings : mapping of str to str
        Of the control: every one with its value.
    errors : tuple of CompensatedError
        Those of which anything was written.
    left_out : tuple of LeftOut
    files : mapping of str to bytes
        Content by file name.
    volume : InVolume or None
        What the tables of all axes leave within the travel of the tests; None of positioning tests, and of one axis.
    verdict : tuple of Check
    """

    campaign: Campaign
    control: str
    title: str
    settings: Mapping[str, str]
    errors: tuple[CompensatedError, ...]
    left_out: tuple[LeftOut, ...]
    files: Mapping[str, bytes]
    volume: InVolume | None
    verdict: tuple[Check, ...]

    def __getitem__(self, name: str) -> CompensatedError:
        """The error of this name: `E_XX`."""
        return {one.error.name: one for one in self.errors}[name]

    def write(self, folder: str | Path) -> tuple[Path, ...]:
        """Write the files of the control to a folder: all of them, or none.

        Raises
        ------
        UnsupportedError
            If there is nothing to write.
        """
        if not self.files:
            raise UnsupportedError(
                "there is nothing to write: no error was found that is greater than its uncertainty, and that this control "
                "compensates; see what was left out"
            )
        return write_whole({Path(folder) / name: content for name, content in self.files.items()})
