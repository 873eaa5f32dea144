"""SINUMERIK high-frequency data: the JSON files that the recorders of Siemens' edge computers write for a SINUMERIK control.

One object: `Header`, `Payload`, `Footer`. `Header.SignalListHFData` lists the signals (`Name` such as `CURRENT|1`, `Axis`
such as `X1`, `Type`, `Address`). `Payload` is a list of objects, of which those with `HFData` hold rows of numbers in the
order of that list, one row for each cycle of the position controller; the signal `CYCLE` is the counter of those cycles, and
`Header.CycleTimeMs` is their length. Other objects (`HFBlockEvent`, `HFCallEvent`, `HFTimestamp`, `LFData`) are not signals
of that clock: they are counted and left out.

The file says no unit. According to the maker's table of signals positions are in mm or degrees as the axis is linear or
rotary; so the unit of a channel is for the test file to say.

Layout seen in: Siemens, SINUMERIK Data Recorder, documentation of the data output format (header object, payload; output
versions 0.6 to 1.1), and SINUMERIK Connector, table of HF data (counter from 0 to 2147483647); the recording that comes with
the public repository max-scw/CaptureDataParser (output version 1.0, 840D sl, 2 ms).
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log, in_time_order
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.text.table import MAX_COLUMNS
from elastogeo.machine import Array

_COUNTER = "CYCLE"
_TURN = 2.0**31
"""The counter begins again at zero after 2147483647."""


def can_read(head: bytes) -> bool:
    """Whether these first bytes are JSON with a header that lists signals of high-frequency data."""
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    return text.startswith(b"{") and b'"Header"' in text and b'"SignalListHFData"' in text


def read_sinumerik(data: bytes, source: str) -> Log:
    """Read a file of SINUMERIK high-frequency data.

    Raises
    ------
    FormatError
        If it is no JSON, or not laid out as the module says, or two rows of one cycle differ.
    """
    document = _document(data, source)
    header, payload = document.get("Header"), document.get("Payload")
    if not isinstance(header, dict) or not isinstance(payload, list):
        raise FormatError(f"{source}: has no object 'Header' or no list 'Payload'; export the recording again")
    names, axes = _signals(header.get("SignalListHFData"), source)
    values = _values(payload, len(names), source)
    notes = _left_out(payload)
    missing = [
        f"{name} ({count} of {len(values)})" for name, count in zip(names, np.isnan(values).sum(0), strict=True) if count
    ]
    if missing:
        notes.append(f"samples without a number, kept as such: {', '.join(missing)}")
    time, values = _timed(header, names, values, notes, source)
    channels = {
        name: Channel(name, "", np.ascontiguousarray(values[:, k]), time)
        for k, name in enumerate(names)
        if name != _COUNTER or time is None
    }
    return Log(channels, _metadata(header, axes), source, tuple(notes))


def _document(data: bytes, source: str) -> dict[str, Any]:
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FormatError(f"{source}: byte {error.start} is no UTF-8; copy the file again") from None
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        whole = text.rstrip()
        if error.pos >= len(whole) or not whole.endswith("}"):
            raise FormatError(
                f"{source}: the JSON is cut off: it ends at byte {len(data)}; copy or export it again"
            ) from None
        at = len(text[: error.pos].encode()) + len(data) - len(text.encode())
        raise FormatError(f"{source}: the JSON is damaged at byte {at} ({error.msg}); copy or export it again") from None
    except RecursionError:
        raise FormatError(f"{source}: its JSON is nested deeper than any recording; export it again") from None
    except ValueError:
        raise FormatError(f"{source}: holds a number of thousands of digits; no recording does, export it again") from None
    if not isinstance(document, dict):
        raise FormatError(f"{source}: is a JSON {type(document).__name__}, not an object with 'Header' and 'Payload'")
    return document


def _signals(listed: Any, source: str) -> tuple[list[str], dict[str, str]]:
    """The names of the signals in the order of a row, and the axis of each."""
    if not isinstance(listed, list) or not listed:
        raise FormatError(f"{source}: Header.SignalListHFData lists no signal; record high-frequency data")
    if len(listed) > MAX_COLUMNS:
        raise FormatError(f"{source}: {len(listed)} signals arrived, at most {MAX_COLUMNS} are read; record fewer at once")
    axes: dict[str, str] = {}
    for place, entry in enumerate(listed, 1):
        name = (entry.get("Name") or entry.get("Address")) if isinstance(entry, dict) else None
        if not isinstance(name, str):
            raise FormatError(f"{source}: signal {place} of Header.SignalListHFData has no 'Name'; export it again")
        if name in axes:
            raise FormatError(f"{source}: Header.SignalListHFData lists {name[:60]!r} twice; export it again")
        axes[name] = str(entry.get("Axis") or "")
    return list(axes), axes


def _values(payload: Sequence[Any], width: int, source: str) -> Array:
    """All rows of high-frequency data, shape (m, width); NaN where a row has no number."""
    blocks = [np.empty((0, width))]
    for place, entry in enumerate(payload, 1):
        rows = entry.get("HFData", []) if isinstance(entry, dict) else None
        if not isinstance(rows, list):
            raise FormatError(f"{source}: entry {place} of Payload is not laid out as high-frequency data; export it again")
        blocks.append(_block(rows, width, f"{source}, Payload entry {place}"))
    values = np.concatenate(blocks)
    if not len(values):
        raise FormatError(f"{source}: its Payload holds no row of HFData; record again")
    return values


def _block(rows: Sequence[Any], width: int, where: str) -> Array:
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list) or len(row) != width:
            arrived = f"{len(row)} numbers" if isinstance(row, list) else f"{row!r:.40}"
            raise FormatError(f"{where}, row {number}: {arrived} arrived for {width} signals; export the recording again")
        if not set(map(type, row)) <= {float, int, type(None)}:
            wrong = next(cell for cell in row if type(cell) not in (float, int, type(None)))
            raise FormatError(f"{where}, row {number}: {wrong!r:.40} is no number; export the recording again")
    try:
        values = np.array(rows, dtype=np.float64).reshape(-1, width)
    except OverflowError:
        raise FormatError(f"{where}: holds a number that is too large; export the recording again") from None
    values[~np.isfinite(values)] = np.nan
    return values


def _timed(
    header: Mapping[str, Any], names: Sequence[str], values: Array, notes: list[str], source: str
) -> tuple[Array | None, Array]:
    """Time since the first cycle [s], and the rows in its order; None if the file keeps no clock."""
    if _COUNTER not in names:
        notes.append(f"the signal {_COUNTER} was not recorded, so the file keeps no clock")
        return None, values
    counter = values[:, names.index(_COUNTER)]
    known = np.flatnonzero(np.isfinite(counter))
    if len(known) < len(values):
        notes.append(f"{len(values) - len(known)} rows have no cycle: left out")
    if not len(known):
        raise FormatError(f"{source}: no row has a cycle; record the signal {_COUNTER} again")
    counter = _unwrapped(counter[known], notes)
    keep, put_right = in_time_order(counter, list(values[known].T), f"{source}, signal {_COUNTER}")
    notes += put_right
    counter, values = counter[keep], values[known][keep]
    cycle = header.get("CycleTimeMs")
    if isinstance(cycle, int | float) and cycle is not True and 0 < cycle < 1e4:
        return (counter - counter[0]) * cycle / 1000, values
    if (np.diff(counter) != 1).any():
        raise FormatError(
            f"{source}: {_COUNTER} leaves cycles out and Header.CycleTimeMs is {cycle!r:.20}, so the time of a row is open; "
            f"write the cycle time of the position controller there"
        )
    notes.append("Header.CycleTimeMs is missing, so the file keeps no clock; no cycle is left out")
    return None, values


def _unwrapped(counter: Array, notes: list[str]) -> Array:
    """The counter without its jumps back to zero at 2147483647."""
    jumps = np.diff(counter) < -_TURN / 2
    if jumps.any():
        notes.append(f"the cycle counter began again at zero {int(jumps.sum())} time(s): counted on")
    return counter + _TURN * np.concatenate(([0.0], np.cumsum(jumps)))


def _left_out(payload: Sequence[Mapping[str, Any]]) -> list[str]:
    counts = Counter(key for entry in payload for key in entry if key != "HFData")
    if not counts:
        return []
    return [
        "not of the high-frequency clock, left out: " + ", ".join(f"{key[:40]} ({n})" for key, n in counts.most_common(8))
    ]


def _metadata(header: Mapping[str, Any], axes: Mapping[str, str]) -> dict[str, str]:
    found = {f"axis of {name}": axis for name, axis in axes.items() if axis and name != _COUNTER}
    for table, key in (("MachineInfo", "MachineName"), ("Initial", "Time"), ("Version", "RecorderVersion")):
        inner = header.get(table)
        if isinstance(inner, dict) and isinstance(inner.get(key), str):
            found[f"{table}.{key}"] = inner[key]
    if isinstance(header.get("Description"), str):
        found["Description"] = header["Description"]
    return found


def _sample() -> bytes:
    signals = [
        {"Name": name, "Type": "DOUBLE", "Axis": axis, "Address": name}
        for name, axis in (("CYCLE", "Cycle"), ("ENC_POS|1", "X1"), ("CURRENT|1", "X1"))
    ]
    header = {"Description": "a sample, of no machine", "SignalListHFData": signals, "CycleTimeMs": 2}
    payload = [
        {"HFData": [[1001, 10.0, 0.5], [1002, 10.25, 0.75]]},
        {"HFBlockEvent": {"HFProbeCounter": 1002, "GCode": "G1 X20"}},
        {"HFData": [[1003, 10.75, -0.25]]},
    ]
    return (f'{{\n"Header":\n{json.dumps(header)}\n,"Payload":\n{json.dumps(payload)}\n,"Footer":\n{{}}\n}}\n').encode()


register(LogFormat("SINUMERIK high-frequency data", ".json", can_read, read_sinumerik, _sample))
