"""Renishaw ball-bar tests (`.b5r`, XML): the radial readings of each run, with their angles.

The maker publishes no description. The structure is as far as known from public programs that read or imitate such files:
asaelrios/qc20-readings (`READINGS`, numbers between blanks, after the `RUN_DIRECTION` of their run), suning2018 (`FEATURE`
with `NAME`, and the unit in `DT`: `UT_LENGTH_MM`, `UT_LENGTH_UM`, ...; `OPERATOR`, `MACHINE_TESTED`, ...) and a generator of
test files (the tree from `TEST_DOCUMENT` down to `NOMINAL_LENGTH` and `BALLBAR_RUN`). **Not known** are the names of the
start and end angle, sample rate and overshoot, and the unit of `READINGS`. So a value is found by the words in its
element's name, in the run or else in the test; a unit is taken from `DT`, or from what settles it: readings near the nominal
length are lengths in mm, and the run's own `AF_CIRCULARITY` tells mm from um. Where nothing settles it the file is refused.
"""

from __future__ import annotations

import math
import re
from array import array

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.run_files import RunFormat, only_run, register
from elastogeo.formats.runs.arc_angles import Arc, sense_from_text, sense_name
from elastogeo.formats.text.delimited import NUMBER
from elastogeo.formats.text.table import SHOWN, Table, problems_error
from elastogeo.formats.text.units import UNITS, to_internal
from elastogeo.formats.text.xml_elements import Element, read_elements
from elastogeo.machine import Array

MAX_RUNS = 100
MAX_READINGS = 200_000
MAX_NUMBER = 40
STROKE = 5.0
"""No ball bar's length changes by more than this [mm]; it tells a length from a change of length."""

_ROOT = re.compile(rb"<([A-Za-z_][\w.-]{0,40}:)?TEST_DOCUMENT[\s/>]")
_UNITS = {
    "UT_LENGTH_MM": "mm",
    "UT_LENGTH_UM": "um",
    "UT_LENGTH_M": "m",
    "UT_FEEDRATE": "mm/min",
    "UT_SPEED": "mm/s",
    "UT_ANGLE": "deg",
    "UT_SERVO_MISMATCH": "ms",
    "UT_SQUARENESS": "um/m",
    "UT_SCALE_ERROR": "ppm",
    "UT_PERCENT": "percent",
    "UT_RANKING": "",
}
_START = re.compile(r".*START.*ANGLE.*|.*ANGLE.*START.*")
_END = re.compile(r".*(END|STOP|FINISH).*ANGLE.*|.*ANGLE.*_(END|STOP|FINISH).*")
_OVERSHOOT = re.compile(r".*OVERSHOOT.*")
_RATE = re.compile(r".*SAMPL.*(RATE|FREQ).*")
_RADIUS = re.compile(r"NOMINAL_(LENGTH|RADIUS)")
_FEEDS = (re.compile(r"AF_CALCULATED_FEEDRATE"), re.compile(r"PROGRAMMED_FEEDRATE|FEEDRATE"))
_TOLD = {"OPERATOR": "operator", "DATE_STARTED": "date", "SERIAL_NUMBER": "serial number", "PART_NUMBER": "part number"}
_STAMP = re.compile(r"(\d{4})(\d\d)(\d\d)-(\d\d)(\d\d)(\d\d)", re.ASCII)
"""How these files write a date with its time of day."""
_NAMED = {("TEST_SPEC", "NAME"): "test", ("MACHINE_TESTED", "NAME"): "machine", ("PLANE", "TEST_PLANE"): "plane"}


def can_read(head: bytes) -> bool:
    """Whether these first bytes begin an XML file with the root `TEST_DOCUMENT`."""
    text = head[:4096].removeprefix(b"\xef\xbb\xbf").removeprefix(b"\xff\xfe").removeprefix(b"\xfe\xff").replace(b"\0", b"")
    return text.lstrip()[:1] == b"<" and _ROOT.search(text) is not None


def read_b5r(data: bytes, source: str) -> Table:
    """Read a ball-bar test that holds one run; otherwise as `read_b5r_runs`."""
    return only_run(read_b5r_runs(data, source), source)


def read_b5r_runs(data: bytes, source: str) -> tuple[Table, ...]:
    """Read all runs of a ball-bar test.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    tuple of Table
        For each run, in the order of the file: `angle` [rad] (falling where the run went clockwise), `radial` [mm], the
        change of the bar's length from the nominal; metadata with the test's names, the `direction` and all features as
        written, with their unit.

    Raises
    ------
    FormatError
        If the file is damaged or holds no readings, or angles or units do not follow from it without doubt.
    """
    root = read_elements(data, source)
    if root.tag != "TEST_DOCUMENT":
        raise FormatError(f"{source}: is no ball-bar test, which is a <TEST_DOCUMENT>; export the run as CSV")
    found = [(node, child) for node in (root, *root.walk()) for child in node.children if child.tag == "READINGS"]
    if not found:
        raise FormatError(f"{source}: has results but no READINGS of a run; save the test with its raw data")
    if len(found) > MAX_RUNS:
        raise FormatError(f"{source}: holds {len(found)} runs, at most {MAX_RUNS} are read; this is no ball-bar test")
    return tuple(_run(root, parent, readings, k, source) for k, (parent, readings) in enumerate(found, 1))


def _run(root: Element, parent: Element, readings: Element, number: int, source: str) -> Table:
    """One run: its readings with their angles, and all that is said about it."""
    where = f"{source}, run {number}"
    sense, own = _about(parent, readings, where)
    test = list(root.walk("RUN_RESULTS", parent.tag, "ANALYSIS"))
    start, own_start = _value(own, test, _START, "deg", where)
    end, own_end = _value(own, test, _END, "deg", where)
    radius = _value(own, test, _RADIUS, "mm", where)[0]
    feed = next((v for pattern in _FEEDS if (v := _value(own, test, pattern, "mm/min", where)[0]) is not None), None)
    rate = _value(own, test, _RATE, "Hz", where)[0]
    overshoot = _value(own, test, _OVERSHOOT, "deg", where)[0]
    arc = Arc(start, end, sense, radius, feed, rate, abs(overshoot or 0.0), shared=not (own_start or own_end))
    values = _numbers(readings, where)
    angle = arc.angles(len(values), where)
    circularity = _value(own, [], re.compile("AF_CIRCULARITY"), "mm", where)[0]
    radial = _radial(values, readings.attributes.get("DT"), angle, radius, circularity, where)
    metadata = {**_told(root), "run": str(number), "direction": sense_name(sense)}
    metadata |= _features(own, "") | _features(
        [e for a in root.walk() if a.tag == "ANALYSIS" for e in a.walk()], "analysis "
    )
    return Table({"angle": angle, "radial": radial}, metadata, source)


def _about(parent: Element, readings: Element, where: str) -> tuple[int, list[Element]]:
    """The sense of a run, and all elements that are about it: those beside its readings, up to another run's."""
    place = next(k for k, child in enumerate(parent.children) if child is readings)
    directions = [k for k, child in enumerate(parent.children) if child.tag == "RUN_DIRECTION"]
    begin = max((k for k in directions if k < place), default=None)
    if begin is None:
        raise FormatError(f"{where}: no RUN_DIRECTION stands before its READINGS; export the run as CSV with its angles")
    beside = parent.children
    if len(directions) > 1:
        beside = beside[begin : min((k for k in directions if k > place), default=None)]
    own = [element for child in beside for element in (child, *child.walk())]
    return sense_from_text(parent.children[begin].text, where), own


def _value(
    own: list[Element], test: list[Element], name: re.Pattern[str], unit: str, where: str
) -> tuple[float | None, bool]:
    """The one value of that name in the run, or else in the test [internal unit], and whether it is the run's own."""
    for scope in (own, test):
        named = [element for element in scope if element.text and name.fullmatch(_name(element).upper())]
        values = {_converted(element, unit, where) for element in named}
        if len(values) > 1:
            names = ", ".join(f"{_name(e)[:40]} {e.text[:20]}" for e in named[:SHOWN])
            raise FormatError(f"{where}: several values may be meant ({names}); export the run as CSV with its angles")
        if values:
            return values.pop(), scope is own
    return None, False


def _converted(element: Element, unit: str, where: str) -> float:
    stated = element.attributes.get("DT")
    spelled = unit if stated is None or unit == "Hz" else _UNITS.get(stated, "")
    number = _number(element.text)
    known = spelled == unit or (spelled in UNITS and unit in UNITS and UNITS[spelled].dimension == UNITS[unit].dimension)
    value = number if unit == "Hz" else float(to_internal(number, spelled if known else ""))
    if not known or not math.isfinite(value):
        said = f"{element.text[:40]!r} with the unit {(stated or 'none')[:40]}"
        raise FormatError(f"{where}: {_name(element)[:40]} is {said}; a number in {unit} was expected: save the test again")
    return value


def _numbers(readings: Element, where: str) -> Array:
    """All numbers of an element, as written; between blanks or semicolons, with a decimal point."""
    if readings.children:
        raise FormatError(
            f"{where}: its READINGS hold <{readings.children[0].tag[:40]}>, not numbers; export the run as CSV"
        )
    values = array("d")
    problems: list[str] = []
    bad = 0
    for count, token in enumerate(re.finditer(r"[^\s;]+", readings.text), 1):
        text = token[0]
        number = _number(text)
        if not math.isfinite(number):
            bad += 1
            if len(problems) < SHOWN:
                problems.append(f"reading {count} is {text[:40]!r}, not a number with a decimal point; export the run again")
        elif not bad:
            values.append(number)
        if count > MAX_READINGS:
            raise FormatError(f"{where}: has more than {MAX_READINGS} readings; this is no ball-bar test")
    if bad:
        raise problems_error(where, problems, bad, "readings cannot be read (nothing was read)")
    return np.array(values, dtype=np.float64)


def _number(text: str) -> float:
    """A plain number with a decimal point, or NaN."""
    return float(text) if len(text) <= MAX_NUMBER and "," not in text and NUMBER.fullmatch(text) else math.nan


def _name(element: Element) -> str:
    """What an element is called: the `NAME` of a `FEATURE`, else its tag."""
    return element.attributes.get("NAME", "") if element.tag == "FEATURE" else element.tag


def _radial(
    values: Array, dt: str | None, angle: Array, radius: float | None, circularity: float | None, where: str
) -> Array:
    """Readings as changes of length [mm]."""
    if dt is not None:
        unit = _UNITS.get(dt, "")
        if unit not in UNITS or UNITS[unit].dimension != "length":
            raise FormatError(f"{where}: its READINGS are in {dt[:40]!r}; known are UT_LENGTH_MM, UT_LENGTH_UM, UT_LENGTH_M")
    elif radius is not None and radius > 2 * STROKE and np.all(np.abs(values - radius) < STROKE):
        unit = "mm"
    else:
        unit = _settled(values, angle, circularity, where)
    lengths = to_internal(values, unit)
    if radius is not None and radius > 2 * STROKE and np.all(np.abs(lengths - radius) < STROKE):
        return lengths - radius
    if np.all(np.abs(lengths) < STROKE):
        return lengths
    far = float(lengths[np.argmax(np.abs(lengths))])
    raise FormatError(
        f"{where}: a reading of {far:.6g} mm is neither a change of length nor near the nominal; export it again"
    )


def _settled(values: Array, angle: Array, circularity: float | None, where: str) -> str:
    """The unit in which the centred readings are about as uncircular as the run's own result says."""
    if circularity:
        design = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
        with np.errstate(over="ignore", invalid="ignore"):
            scale = float(np.max(np.abs(values))) or 1.0
            residual = values / scale - design @ np.linalg.lstsq(design, values / scale, rcond=None)[0]
            span = float(np.ptp(residual)) * scale
        for unit in ("mm", "um"):
            if 0.1 < float(to_internal(span, unit)) / abs(circularity) < 10.0:
                return unit
    raise FormatError(
        f"{where}: its READINGS state no unit (DT), and the run's AF_CIRCULARITY does not settle it; "
        'write DT="UT_LENGTH_UM" or "UT_LENGTH_MM" into <READINGS>, whichever is true, or export the run as CSV'
    )


def _told(root: Element) -> dict[str, str]:
    """What the file says about the test."""
    told: dict[str, str] = {}
    for element in root.walk("RUN_RESULTS", "ANALYSIS"):
        if element.tag in _TOLD and element.text:
            told.setdefault(_TOLD[element.tag], _STAMP.sub(r"\1-\2-\3T\4:\5:\6", element.text))
        for (tag, attribute), key in _NAMED.items():
            if element.tag == tag and element.attributes.get(attribute):
                told.setdefault(key, element.attributes[attribute])
    return told


def _features(elements: list[Element], prefix: str) -> dict[str, str]:
    """All features as written, with the unit in their key."""
    features = {}
    for element in elements:
        if element.tag == "FEATURE" and _name(element):
            unit = _UNITS.get(element.attributes.get("DT", ""), element.attributes.get("DT", ""))
            features[f"{prefix}{_name(element)}{'_' if unit else ''}{unit}"] = element.text
    return features


def _sample() -> bytes:
    return b"""<?xml version="1.0" encoding="utf-8"?>
<TEST_DOCUMENT>
  <TEST_SPEC NAME="a sample, of no machine"><INSTRUMENT><DYNAMIC_BALLBAR><NOMINAL_LENGTH>150</NOMINAL_LENGTH>
    <START_ANGLE>0</START_ANGLE><END_ANGLE>360</END_ANGLE></DYNAMIC_BALLBAR></INSTRUMENT></TEST_SPEC>
  <RUN_RESULTS><BALLBAR_RUN><RUN_DIRECTION>CCW</RUN_DIRECTION>
    <READINGS DT="UT_LENGTH_UM">0.1 -2.5 1e-17 3.25 0.5</READINGS></BALLBAR_RUN></RUN_RESULTS>
</TEST_DOCUMENT>
"""


register(RunFormat("Renishaw ball bar", ".b5r", can_read, read_b5r, _sample, read_runs=read_b5r_runs))
