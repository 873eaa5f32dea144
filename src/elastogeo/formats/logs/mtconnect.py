"""MTConnect streams (XML): the observations that an agent answers to a `sample` or `current` request.

The layout is that of the standard (mtconnect/standard_doc_generator, observations: *ObservationInformationModel*,
*Representations*) and of the agent (mtconnect/cppagent): `MTConnectStreams` > `Header`, `Streams` > `DeviceStream` >
`ComponentStream` > `Samples`, `Events`, `Condition`, and in these one element for each observation, named after its type,
with `dataItemId`, `timestamp`, `sequence` and perhaps `name`. The text is the value, `UNAVAILABLE` if there is none. A
time series (`...TimeSeries`, with `sampleCount` and `sampleRate`) holds values at equal steps; its `timestamp` is that of
the **last**.

An agent reports a value when it changes: between its samples a channel holds. A stream gives no units (the probe document
does), so channels have none, unless an observation has the attribute `units`.

What is put right, with a note: observations out of the order of time; those repeated. Of different values of one item at
one time the one with the highest sequence number is kept, because it is the value that held from that time on; where that
would drop more than a tenth of an item's samples, its clock is too coarse to be used, and the file is refused. Left out,
with a note: conditions, data sets and tables, items of text, of several numbers (positions in space), or never available,
and time series without a rate. Refused: a sample that is no number, two observations of one sequence number that differ,
series that overlap.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Mapping

from elastogeo.errors import FormatError
from elastogeo.formats.log import Log
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.logs.mtconnect_observations import NUMBER, Item, Observations, numbers_of, rate_of, stamp_of
from elastogeo.formats.text.units import UNITS
from elastogeo.formats.text.xml_elements import MAX_DEPTH, MAX_ELEMENTS, feed_elements, local

_ROOT = re.compile(rb"<([A-Za-z_][\w.-]{0,40}:)?MTConnectStreams[\s/>]")
_SEQUENCE = re.compile(r"\d{1,19}", re.ASCII)
_SECTIONS = ("Samples", "Events")
_HEADER = ("creationTime", "sender", "instanceId", "version")


def can_read(head: bytes) -> bool:
    """Whether these first bytes begin an XML file with the root `MTConnectStreams`."""
    text = head[:4096].removeprefix(b"\xef\xbb\xbf").removeprefix(b"\xff\xfe").removeprefix(b"\xfe\xff").replace(b"\0", b"")
    return text.lstrip()[:1] == b"<" and _ROOT.search(text) is not None


def read_mtconnect(data: bytes, source: str) -> Log:
    """Read an answer of an MTConnect agent.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Log
        A channel for each data item of numbers, by its name (else its id), time [s] from the earliest observation, which the
        metadata name as `start`; NaN where it was unavailable.

    Raises
    ------
    FormatError
        If the XML is damaged, an observation lacks its time or sequence, a sample is no number, or its clock is not usable.
    """
    target = _Streams(source, MAX_ELEMENTS + len(data) // 40)
    feed_elements(data, source, target)
    channels, start, notes = target.items.channels(source)
    for count, what in ((target.conditions, "conditions"), (target.sets, "entries of data sets and tables")):
        if count:
            notes.append(f"{count} {what} are left out")
    return Log(channels, {**target.header, "start": stamp_of(start)}, source, tuple(notes))


class _Streams:
    """What the XML parser tells of a stream."""

    def __init__(self, source: str, most: int) -> None:
        self.source, self.most = source, most
        self.header: dict[str, str] = {}
        self.items = Observations()
        self.conditions = self.sets = 0
        self._path: list[str] = []
        self._count = self._depth = 0
        self._about: dict[str, str] = {}
        self._text = io.StringIO()

    def start(self, tag: str, attributes: Mapping[str, str]) -> None:
        """Note where an element stands, and open an observation."""
        tag = local(tag)
        self._count += 1
        if len(self._path) >= MAX_DEPTH or self._count > self.most:
            raise FormatError(f"{self.source}: has too many elements (<{tag[:40]}>) for a stream; check what it is")
        if not self._path and tag != "MTConnectStreams":
            raise FormatError(f"{self.source}: is <{tag[:40]}>, not <MTConnectStreams>; save the answer to a sample request")
        section = self._path[-1] if self._path else ""
        self._path.append(tag)
        if self._depth:
            self.sets += tag in ("Entry", "Cell")
        elif section in _SECTIONS:
            self._about, self._text, self._depth = dict(attributes), io.StringIO(), len(self._path)
        elif section == "Condition":
            self.conditions += 1
        elif tag == "Header":
            self.header = {key: attributes[key] for key in _HEADER if key in attributes}
        elif tag == "DeviceStream" and "name" in attributes:
            self.header.setdefault("device", attributes["name"])

    def data(self, text: str) -> None:
        """Take the text of an observation."""
        if self._depth and self._depth == len(self._path):
            self._text.write(text)

    def end(self, tag: str) -> None:  # noqa: ARG002
        """Close an element, and take an observation."""
        if self._depth == len(self._path):
            self._observe(self._path[-1], self._path[-2], self._about, self._text.getvalue().strip())
            self._depth = 0
        self._path.pop()

    def close(self) -> None:
        """There is nothing to close."""

    def _observe(self, tag: str, section: str, about: Mapping[str, str], text: str) -> None:
        """Take an observation in the section `Samples` or `Events`."""
        key, sequence = about.get("dataItemId", ""), about.get("sequence", "")
        where = f"{self.source}, <{tag[:40]}> {about.get('name', key)[:40]!r}, sequence {sequence[:20] or 'none'}"
        if not key or not _SEQUENCE.fullmatch(sequence):
            raise FormatError(f"{where}: has no {'sequence number' if key else 'dataItemId'}; save the agent's whole answer")
        time = self.items.nanoseconds(about.get("timestamp", ""), where)
        item = self.items.item(key, about.get("name") or key, where)
        if about.get("units") in UNITS:
            item.unit = about["units"]
        if "count" in about:
            item.set_text("a set")
        elif text.upper() == "UNAVAILABLE":
            item.add(time, int(sequence), (math.nan,))
        elif "sampleCount" in about:
            self._observe_series(item, time, int(sequence), about, text, where)
        elif NUMBER.fullmatch(text) and math.isfinite(float(text)):
            item.add(time, int(sequence), (float(text),))
        elif section == "Events" or (" " in text and all(NUMBER.fullmatch(cell) for cell in text[:1000].split())):
            item.set_text(text)
        else:
            raise FormatError(f"{where}: the sample {text[:40]!r} is not a finite number; correct it or take it out")

    def _observe_series(self, item: Item, time: int, order: int, about: Mapping[str, str], text: str, where: str) -> None:
        """Take a time series."""
        values = numbers_of(text, where)
        if about["sampleCount"] != str(len(values)):
            raise FormatError(f"{where}: promises {about['sampleCount'][:20]} samples, {len(values)} arrived; save it again")
        rate = about.get("sampleRate", "")
        if not rate:
            self.items.rateless[item.name] = None
        elif values:
            item.add(time, order, values, rate_of(rate, len(values), where))


def _sample() -> bytes:
    return b"""<?xml version="1.0" encoding="UTF-8"?>
<MTConnectStreams xmlns="urn:mtconnect.org:MTConnectStreams:1.7">
  <Header creationTime="2026-01-31T12:00:01Z" sender="a sample, of no machine" instanceId="1" version="1.7.0"
    bufferSize="131072" nextSequence="7" firstSequence="1" lastSequence="6"/>
  <Streams><DeviceStream name="mill" uuid="mill-1"><ComponentStream component="Linear" name="X" componentId="x">
    <Samples>
      <Position dataItemId="x1" timestamp="2026-01-31T12:00:00Z" name="Xact" sequence="1" subType="ACTUAL">1.5</Position>
      <Position dataItemId="x1" timestamp="2026-01-31T12:00:00.25Z" name="Xact" sequence="3" subType="ACTUAL">1.75</Position>
      <AmperageTimeSeries dataItemId="x2" timestamp="2026-01-31T12:00:00.5Z" name="Xcurrent" sequence="4" sampleCount="3"
        sampleRate="100">0.5 0.25 -0.5</AmperageTimeSeries>
      <Load dataItemId="x3" timestamp="2026-01-31T12:00:00.5Z" sequence="5">12</Load>
      <Load dataItemId="x3" timestamp="2026-01-31T12:00:00.75Z" sequence="6">UNAVAILABLE</Load>
    </Samples>
    <Events><Execution dataItemId="e1" timestamp="2026-01-31T12:00:00Z" name="mode" sequence="2">ACTIVE</Execution></Events>
  </ComponentStream></DeviceStream></Streams>
</MTConnectStreams>
"""


register(LogFormat("MTConnect streams", ".xml", can_read, read_mtconnect, _sample))
