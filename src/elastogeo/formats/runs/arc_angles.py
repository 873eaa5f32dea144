"""The arc that a ball-bar run went over: angles for readings of which a file gives only number and order.

Ball-bar software samples at a constant rate along a path at constant feed, and writes the readings without their angles.
They follow from the start angle, and either the end angle or feed, radius, sample rate and direction. Nothing is assumed:
what is missing or contradicts itself is said.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.text.table import Column, Table
from elastogeo.formats.text.units import UNITS, split_unit, to_internal
from elastogeo.machine import Array

TOLERANCE = 0.05
"""How far the arc that feed and sample rate make may be from the stated one; a control keeps its feed better than that."""

_CCW = re.compile(r"ccw|(counter|anti)[- ]?clockwise|g0?3", re.IGNORECASE)
_CW = re.compile(r"cw|clockwise|g0?2", re.IGNORECASE)
_VALUE = re.compile(r"(?P<number>[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?)\s*(?P<unit>[^\d\s].{0,15})?", re.ASCII)
_HERTZ = re.compile(r"(?P<name>.*?)[\s_]*[\[(]?\s*(Hz|1/s)\s*[\])]?")
_SIDES = {"radial_ccw": 1, "ccw_radial": 1, "ccw": 1, "radial_cw": -1, "cw_radial": -1, "cw": -1}
_COUNTERS = ("index", "no", "no.", "nr", "nr.", "number", "sample", "point", "reading_no", "reading_no.")
_TURNS = 100 * math.tau
_POSSIBLE = {
    "start": (-_TURNS, _TURNS),
    "end": (-_TURNS, _TURNS),
    "overshoot": (0.0, _TURNS),
    "radius": (0.1, 1e5),
    "feed": (1e-4, 1e4),
    "rate": (1e-2, 1e7),
}
_DIMENSIONS = {"start": "angle", "end": "angle", "overshoot": "angle", "radius": "length", "feed": "feed", "rate": "rate"}
_FIELDS = {
    **dict.fromkeys(("start_angle", "angle_start"), "start"),
    **dict.fromkeys(("end_angle", "stop_angle", "angle_end"), "end"),
    **dict.fromkeys(("overshoot", "angular_overshoot", "overshoot_angle"), "overshoot"),
    **dict.fromkeys(("radius", "nominal_radius", "nominal_length", "ballbar_length", "bar_length", "test_radius"), "radius"),
    **dict.fromkeys(("feed", "feed_rate", "feedrate", "programmed_feedrate"), "feed"),
    **dict.fromkeys(("sample_rate", "sampling_rate", "sample_frequency", "sampling_frequency"), "rate"),
    **dict.fromkeys(("direction", "run_direction"), "direction"),
}


@dataclass(frozen=True, slots=True)
class Arc:
    """What a file says about the path of a run; None where it says nothing.

    Attributes
    ----------
    start, end : float or None [rad]
        Angle of the first and of the last reading.
    sense : int or None
        1 counter-clockwise (angles rise), -1 clockwise.
    radius : float or None [mm]
    feed : float or None [mm/s]
    rate : float or None [1/s]
        Readings per second.
    overshoot : float [rad]
        What the path goes beyond the arc at each end.
    shared : bool
        Whether start and end are those of the test: a run against their order went from end to start.
    """

    start: float | None = None
    end: float | None = None
    sense: int | None = None
    radius: float | None = None
    feed: float | None = None
    rate: float | None = None
    overshoot: float = 0.0
    shared: bool = False

    def angles(self, count: int, where: str) -> Array:
        """Angle of each of `count` readings, shape (count,) [rad]: the first at the start, the last at the end.

        Where the readings go on over the stated overshoot, which feed and sample rate tell, so do the angles.

        Raises
        ------
        FormatError
            If what the file says does not suffice or contradicts itself.
        """
        if self.start is None:
            raise FormatError(f"{where}: gives no angles and no start angle; add 'start angle [deg]: 0' or an angle column")
        self._check(where)
        if count < 2:
            raise FormatError(f"{where}: one reading makes no arc; export the whole run")
        if self.end is None:
            return self._onwards(self.start, count, where)
        start, end = self._ends(self.start, self.end, where)
        beyond = math.copysign(self._beyond(abs(end - start), count, where), end - start)
        return np.linspace(start - beyond, end + beyond, count, dtype=np.float64)

    def _check(self, where: str) -> None:
        """Check that all that is stated is possible."""
        for name, (least, most) in _POSSIBLE.items():
            value = getattr(self, name)
            if value is not None and not least <= value <= most:
                raise FormatError(f"{where}: its {name} cannot be {value:.6g}; correct it or leave it out")

    def _onwards(self, start: float, count: int, where: str) -> Array:
        """Angles from the start on, by feed and sample rate."""
        needed = {"direction": self.sense, "radius": self.radius, "feed rate": self.feed, "sample rate": self.rate}
        missing = [name for name, value in needed.items() if not value]
        if missing or not (self.sense and self.radius and self.feed and self.rate):
            raise FormatError(
                f"{where}: gives no angles and no end angle; to compute them without it, {', '.join(missing)} "
                "must be given too; add 'end angle [deg]: 360' or those"
            )
        if self.overshoot:
            raise FormatError(f"{where}: states an overshoot but no end angle, so where the arc begins is open; add it")
        return start + self.sense * self.feed / (self.radius * self.rate) * np.arange(count, dtype=np.float64)

    def _ends(self, start: float, end: float, where: str) -> tuple[float, float]:
        """Angles of the first and of the last reading, in the sense of the run."""
        if start == end:
            raise FormatError(f"{where}: start and end angle are the same; for a full circle write for example 0 and 360")
        if self.sense in (None, 1 if end > start else -1):
            return start, end
        if self.shared or math.isclose(abs(end - start), math.tau, rel_tol=1e-9):
            return end, start
        said = f"from {math.degrees(start):.6g} to {math.degrees(end):.6g} deg"
        raise FormatError(f"{where}: an arc {said} is not {sense_name(self.sense)}; correct the angles or the direction")

    def _beyond(self, span: float, count: int, where: str) -> float:
        """What the readings go beyond the arc at each end: nothing, or the stated overshoot."""
        if not (self.radius and self.feed and self.rate):
            if self.overshoot:
                raise FormatError(
                    f"{where}: states an overshoot of {math.degrees(self.overshoot):.6g} deg, and not whether the readings "
                    "include it; give radius, feed rate and sample rate, or an angle column"
                )
            return 0.0
        travelled = (count - 1) * self.feed / (self.radius * self.rate)
        near = [b for b in {0.0, self.overshoot} if abs(travelled / (span + 2 * b) - 1) <= TOLERANCE]
        if len(near) != 1:
            beyond = f" (and {math.degrees(self.overshoot):.6g} deg beyond each end)" if self.overshoot else ""
            raise FormatError(
                f"{where}: {count} readings make {math.degrees(travelled):.4g} deg by feed, radius and sample rate, but the "
                f"arc is {math.degrees(span):.4g} deg{beyond}: {'both fit' if near else 'they contradict'}; correct them"
            )
        return near[0]


def sense_from_text(text: str, where: str) -> int:
    """1 for a word that means counter-clockwise (`CCW`, `G3`), -1 for one that means clockwise (`CW`, `G2`).

    Raises
    ------
    FormatError
        For any other.
    """
    word = text.strip()
    for sense, pattern in ((1, _CCW), (-1, _CW)):
        if pattern.fullmatch(word):
            return sense
    raise FormatError(f"{where}: the direction is {word[:40]!r}; write CCW (counter-clockwise) or CW (clockwise)")


def sense_name(sense: int | None) -> str:
    """`CCW`, `CW`, or nothing."""
    return {1: "CCW", -1: "CW"}.get(sense or 0, "")


def check_sides(columns: Sequence[Column], where: str) -> None:
    """Check that columns named by direction only (`CCW`, `CW`) have a unit of length.

    Raises
    ------
    FormatError
        If one has none, or two are of one direction.
    """
    sides = [c for c in columns if c.quantity in _SIDES]
    for column in sides:
        if not column.unit or UNITS[column.unit].dimension != "length":
            raise FormatError(f"{where}: column {column.header!r} has no unit of length; write radial_{column.quantity}_um")
    if len({_SIDES[c.quantity] for c in sides}) < len(sides):
        raise FormatError(f"{where}: two columns are of one direction; keep one radial_ccw and one radial_cw")


def runs_of(table: Table) -> tuple[Table, ...]:
    """The runs that a table of delimited text amounts to.

    Columns `radial_ccw` and `radial_cw` side by side are two runs, in the order of the columns. Where there is no angle
    column but the lines above the numbers tell the arc, the angles are computed; a counting column must count by ones.

    Raises
    ------
    FormatError
        If the arc is told in part, or readings are missing by their count.
    """
    sides = [name for name in table.columns if name in _SIDES]
    radial = sides or [name for name in ("radial",) if name in table.columns]
    arc = _arc(table) if radial and "angle" not in table.columns else None
    if not sides and arc is None:
        return (table,)
    others = {name: values for name, values in table.columns.items() if name not in radial}
    runs = []
    for name in radial:
        columns = {"radial": table.columns[name], **others}
        metadata = dict(table.metadata)
        sense = _SIDES.get(name, arc.sense if arc else None)
        if arc is not None:
            _check_counter(columns, table.source)
            own = replace(arc, sense=sense, shared=len(radial) > 1)
            columns = {"angle": own.angles(table.rows, table.source), **columns}
        if sense:
            metadata["direction"] = sense_name(sense)
        runs.append(Table(columns, metadata, table.source))
    return tuple(runs)


def _arc(table: Table) -> Arc | None:
    """The arc that the metadata of a table tells; None if it does not begin to."""
    told: dict[str, tuple[str, str, str]] = {}
    for key, text in table.metadata.items():
        name, unit = _named(key)
        field = _FIELDS.get(name, "")
        where = f"{table.source}, {key!r}"
        if field in told:
            raise FormatError(f"{where}: gives the {field} a second time; keep one")
        if field:
            told[field] = (text, unit, where)
    if not {"start", "end", "rate", "overshoot"} & told.keys():
        return None
    given = {field: _quantity(*told[field], _DIMENSIONS[field]) for field in told if field != "direction"}
    text, _, where = told.get("direction", ("", "", ""))
    return Arc(
        start=given.get("start"),
        end=given.get("end"),
        sense=sense_from_text(text, where) if where else None,
        radius=given.get("radius"),
        feed=given.get("feed"),
        rate=given.get("rate"),
        overshoot=abs(given.get("overshoot", 0.0)),
    )


def _named(key: str) -> tuple[str, str]:
    hertz = _HERTZ.fullmatch(key)
    if hertz:
        return "_".join(hertz["name"].lower().replace("-", " ").split()), "Hz"
    try:
        name, unit = split_unit(key.replace("-", " "))
    except FormatError:
        return "", ""
    return name, unit


def _quantity(text: str, unit: str, where: str, dimension: str) -> float:
    """A number with its unit, from the key or after the number, in internal units."""
    value = _VALUE.fullmatch(text)
    if value is None or re.fullmatch(r"[-+]?\d{1,3},\d{3}", value["number"]):
        raise FormatError(f"{where}: {text[:40]!r} is not one number without doubt; write for example 150.0 mm")
    unit = unit or (value["unit"] or "").strip()
    hertz = unit in ("Hz", "1/s")
    known = "rate" if hertz else UNITS[unit].dimension if unit in UNITS else ""
    if known != dimension:
        example = {"angle": "deg", "length": "mm", "feed": "mm/min", "rate": "Hz"}[dimension]
        raise FormatError(f"{where}: the unit {unit[:20]!r} is none of {dimension}; write for example [{example}]")
    number = float(value["number"].replace(",", "."))
    number = number if hertz else float(to_internal(number, unit))
    if not math.isfinite(number) or (dimension != "angle" and number <= 0):
        raise FormatError(f"{where}: {text[:40]!r} is not valid; it must be a finite number above zero")
    return number


def _check_counter(columns: Mapping[str, Array], source: str) -> None:
    for name in _COUNTERS:
        if name in columns:
            steps = np.flatnonzero(np.diff(columns[name]) != 1)
            if len(steps):
                row = int(steps[0])
                before, after = columns[name][row : row + 2].tolist()
                raise FormatError(
                    f"{source}: column {name} goes from {before:g} to {after:g} at reading {row + 2}; "
                    "angles can be computed only if no reading is missing: export it again"
                )
