r"""What an MTConnect adapter sends (SHDR, text): `time|name|value|name|value|...`, one line for each instant.

The layout is that of the agent's README and source (mtconnect/cppagent: *Adapter Agent Protocol*, `shdr_tokenizer.hpp`,
`shdr_token_mapper.cpp`, `timestamp_extractor.cpp`): fields between bars, perhaps in quotes with `\|` for a bar; the time
as ISO 8601, or as a number of milliseconds (relative time), perhaps with `@` and the duration of a statistic [s] behind
it; pairs of name and value, `UNAVAILABLE` for none, `value:REASON` for a counter that was reset; a time series as
`name|count|rate|v v v`, its time that of the **last** value; conditions of six fields, messages of three, assets that
begin with `@`; lines that begin with `* ` are commands. Each line ends with a line end.

The text does not say which names are samples, events or conditions, nor any unit. So an item is a channel if all its
values are numbers (or unavailable), and has no unit; a channel holds its value until the next. Of different values of one
name at one time the later line is kept, with a note, up to a tenth of them; more are refused, as are time series that
overlap.

Left out, with a note: items of text, conditions, messages, assets, time series without a rate. Refused: lines without
time, times of both kinds in one file, and a last line without end.
"""

from __future__ import annotations

import io
import math
import re
from collections import Counter

from elastogeo.errors import FormatError
from elastogeo.formats.log import Log
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.logs.mtconnect_observations import NUMBER, Observations, listed, numbers_of, rate_of, stamp_of

MAX_LINE = 1_000_000
MAX_FIELDS = 2000
MAX_QUOTED = 10_000
LEVELS = ("NORMAL", "WARNING", "FAULT", "UNAVAILABLE")

_ISO = re.compile(r"\d{4}-\d\d-\d\dT[\d:.]{8,22}(Z|[+-]\d\d:?\d\d)?(@\d+(\.\d+)?)?", re.ASCII)
_OFFSET = re.compile(r"\d{1,15}(\.\d{1,6})?(@\d+(\.\d+)?)?", re.ASCII)
_KEY = re.compile(r"[^\W\d][\w.:\-\[\] /]{0,200}")
_RESET = re.compile(r"(?P<value>[^:]*):(?P<reason>[A-Z_]{2,40})", re.ASCII)
_QUOTED = re.compile(r'\s*"((?:[^"\\|]|\\.)*)"\s*(?:\||$)|([^|]*)(?:\||$)')
_MULTILINE = "--multiline--"


def can_read(head: bytes) -> bool:
    """Whether these first bytes are commands (`* ...`) and then a line of time, name and value between bars."""
    for line in head[:8192].removeprefix(b"\xef\xbb\xbf").split(b"\n")[:-1]:
        text = line.decode("latin-1").strip()
        if text.startswith("* ") or not text:
            continue
        fields = [field.strip() for field in text.split("|")]
        time = _ISO.fullmatch(fields[0]) or _OFFSET.fullmatch(fields[0])
        return time is not None and len(fields) > 2 and (fields[1][:1] == "@" or _KEY.fullmatch(fields[1]) is not None)
    return False


def read_shdr(data: bytes, source: str) -> Log:
    """Read the lines of an adapter.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Log
        A channel for each name whose values are numbers, time [s] from the earliest of them, which the metadata name as
        `start` unless time is relative; the commands are metadata too.

    Raises
    ------
    FormatError
        If a line is not understood without doubt, the file is cut off, or the clock of an item is not usable.
    """
    if not data.endswith((b"\n", b"\r")):
        raise FormatError(f"{source}: the last line has no end, so it may be cut off; copy it again or take the line out")
    if b"\0" in data:
        raise FormatError(f"{source}: byte {data.index(0)} is zero, so this is no text; copy or export it again")
    try:
        data.decode("utf-8")
        encoding = "utf-8-sig"
    except UnicodeDecodeError:
        encoding = "latin-1"
    adapter = _Adapter(source)
    for number, line in enumerate(io.TextIOWrapper(io.BytesIO(data), encoding=encoding, newline=None), 1):
        adapter.take(line.strip(), number)
    channels, start, notes = adapter.items.channels(source)
    if adapter.until:
        raise FormatError(f"{source}: an asset has no end {adapter.until[:40]!r}; the file is cut off; copy it again")
    for name, doubtful in adapter.doubtful.items():
        if name in adapter.items.items:
            raise FormatError(
                f"{source}, line {doubtful}: may be a condition or hold a value of {name[:40]!r}; put each condition on "
                "a line of its own, and give its item a name that no other has"
            )
    notes += [f"{count} {what} are left out" for what, count in adapter.skipped.items()]
    if adapter.resets:
        notes.append(f"counters were reset: {listed([f'{name} {n} times' for name, n in adapter.resets.items()])}")
    metadata = adapter.commands | ({} if adapter.relative else {"start": stamp_of(start)})
    return Log(channels, metadata, source, tuple(notes))


class _Adapter:
    """The lines of an adapter, one after the other."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.items = Observations()
        self.commands: dict[str, str] = {}
        self.skipped: Counter[str] = Counter()
        self.resets: Counter[str] = Counter()
        self.doubtful: dict[str, int] = {}
        self.relative: bool | None = None
        self.until = ""

    def take(self, text: str, number: int) -> None:
        """Take a line."""
        where = f"{self.source}, line {number}"
        if len(text) > MAX_LINE:
            raise FormatError(f"{where}: is longer than {MAX_LINE} characters; check what it is")
        if text.count("|") > MAX_FIELDS or ('"' in text and len(text) > MAX_QUOTED):
            raise FormatError(f"{where}: has too many fields or too long text in quotes; check what it is")
        if self.until:
            self.until = "" if text == self.until else self.until
        elif text.startswith("*"):
            key, _, value = text[1:].partition(":")
            if value and len(self.commands) < 100:
                self.commands.setdefault(key.strip()[:80], value.strip()[:1000])
        elif text:
            fields = _fields(text)
            self._fields(self._time(fields[0], where), fields[1:], number, where)

    def _time(self, text: str, where: str) -> int:
        """The time of a line [ns]."""
        iso = _ISO.fullmatch(text) is not None
        if not iso and not _OFFSET.fullmatch(text):
            raise FormatError(f"{where}: begins with {text[:40]!r}, which is no time; write it as 2026-01-31T12:00:00.123Z")
        if self.relative == iso:
            raise FormatError(
                f"{where}: the time {text[:40]!r} is not of the kind of those before it; use one kind in a file"
            )
        self.relative = not iso
        stamp, _, duration = text.partition("@")
        if duration:
            self.skipped["durations of statistics"] += 1
        if iso:
            return self.items.nanoseconds(stamp, where)
        whole, _, part = stamp.partition(".")
        return int(whole) * 1_000_000 + int(part.ljust(6, "0"))

    def _fields(self, time: int, fields: list[str], number: int, where: str) -> None:
        """Take what follows the time of a line."""
        if len(fields) % 2 and len(fields) > 1 and not fields[-1]:
            fields = fields[:-1]
        if fields and fields[0].startswith("@"):
            self.skipped["assets"] += 1
            if fields[-1].startswith(_MULTILINE):
                self.until = fields[-1]
        elif len(fields) == 6 and fields[1].upper() in LEVELS and not (fields[1].upper() == LEVELS[-1] and fields[2]):
            self.skipped["conditions"] += 1
            self.doubtful |= {name: number for name in (fields[2], fields[4]) if name and name not in self.doubtful}
        elif len(fields) == 3:
            self.skipped["messages"] += 1
        elif len(fields) == 4 and (NUMBER.fullmatch(fields[2]) or (not fields[2] and fields[1].isdecimal())):
            self._series(time, fields, number, where)
        elif not fields or len(fields) % 2:
            raise FormatError(f"{where}: has {len(fields)} fields after the time; pairs of name and value belong there")
        else:
            for name, value in zip(fields[::2], fields[1::2], strict=True):
                self._value(time, name, value, number, where)

    def _series(self, time: int, fields: list[str], number: int, where: str) -> None:
        """Take a time series: name, count, rate, values."""
        name, count, rate, text = fields
        _check_key(name, where)
        item = self.items.item(name, name, where)
        values = numbers_of(text, where)
        if count != str(len(values)):
            raise FormatError(
                f"{where}: promises {count[:20]!r} samples of {name[:40]!r}, {len(values)} arrived; correct it"
            )
        if not rate:
            self.items.rateless[name] = None
        elif values:
            item.add(time, number, values, rate_of(rate, len(values), where))

    def _value(self, time: int, name: str, value: str, number: int, where: str) -> None:
        """Take a pair of name and value."""
        _check_key(name, where)
        item = self.items.item(name, name, where)
        reset = _RESET.fullmatch(value) if ":" in value else None
        if reset:
            value = reset["value"]
            self.resets[name] += 1
        if value.upper() == "UNAVAILABLE":
            item.add(time, number, (math.nan,))
        elif NUMBER.fullmatch(value) and math.isfinite(float(value)):
            item.add(time, number, (float(value),))
        else:
            item.set_text(value)


def _check_key(name: str, where: str) -> None:
    if not _KEY.fullmatch(name):
        raise FormatError(f"{where}: {name[:40]!r} stands where a name belongs; write time|name|value|name|value")


def _fields(text: str) -> list[str]:
    """The fields of a line, without blanks around and quotes."""
    if '"' not in text:
        return [field.strip() for field in text.split("|")]
    fields = []
    at, ended = 0, False
    while not ended:
        found = _QUOTED.match(text, at)
        if found is None:
            break
        fields.append(re.sub(r"\\(.)", r"\1", found[1]) if found[1] is not None else found[2].strip())
        at, ended = found.end(), not found[0].endswith("|")
    return fields


def _sample() -> bytes:
    return (
        b"* device: a sample, of no machine\n"
        b"2026-01-31T12:00:00.000000Z|Xact|1.5|mode|AUTOMATIC|Xload|12\n"
        b"2026-01-31T12:00:00.250000Z|Xact|1.75|Xload|UNAVAILABLE\n"
        b"2026-01-31T12:00:00.500000Z|Xcurrent|3|100|0.5 0.25 -0.5\n"
        b"2026-01-31T12:00:00.500000Z|htemp|WARNING|HTEMP|1|HIGH|Oil Temperature High\n"
    )


register(LogFormat("SHDR", ".shdr", can_read, read_shdr, _sample))
