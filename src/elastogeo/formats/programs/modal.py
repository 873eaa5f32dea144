"""What the words of ISO 6983 do, block by block: the state that they leave, and the moves that they make."""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import hypot, nan, radians, sqrt

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.program_files import Reading
from elastogeo.machine import PROGRAM_AXES, Comment, Dwell, Packing, Program, Stop

LINEAR = 6
_PLANES = {17: 0, 19: 1, 18: 2}
_FIRST_SECOND = ((0, 1), (1, 2), (2, 0))
_CENTRE_WORDS = ("I", "J", "K")
_MOTIONS = {0: 0, 1: 1, 2: 2, 3: 3}
_NOWHERE = [nan] * len(PROGRAM_AXES)
_COLUMN = {axis: k for k, axis in enumerate(PROGRAM_AXES)}
_RADIAN = radians(1.0)

REFUSED = {
    20: "is inches; post-process the program in millimetres",
    70: "is inches; post-process the program in millimetres",
    31: "probes, and where it stops is not known",
    32: "cuts a thread, whose feed goes with the spindle",
    33: "cuts a thread, whose feed goes with the spindle",
    41: "corrects for the cutter's radius, so that the path is not in the program; post-process the path of the centre",
    42: "corrects for the cutter's radius, so that the path is not in the program; post-process the path of the centre",
    43.4: "gives tool tips for the control to transform; post-process axis positions",
    43.5: "gives tool tips for the control to transform; post-process axis positions",
    50: "sets the origin or scales; give axis positions",
    51: "scales; give axis positions",
    52: "shifts the origin; give axis positions",
    65: "calls a macro; post-process plain blocks",
    66: "calls a macro; post-process plain blocks",
    68: "rotates the coordinates; give axis positions",
    68.2: "tilts the working plane; give axis positions",
    92: "sets the origin; give axis positions",
    95: "is a feed per revolution; give it per minute",
    96: "is a constant cutting speed; give a feed per minute",
    **dict.fromkeys((73, 74, 76, *range(81, 90)), "is a canned cycle; post-process plain blocks"),
}
"""Words that would move axes in a way that is not followed."""

PARAMETERS = {64: "PQ", 54.1: "P", 5.1: "PQR", 61.1: "P", 43: "HP", 44: "HP", 49: "H", 5: "P", 8: "P", 187: "PE"}
"""Words that belong to a word G which moves nothing."""

HARMLESS = {
    *(9, 11, 21, 40, 50.1, 61, 62, 63, 69, 71, 97, 98, 99),
    *range(54, 60),
    *(59.1, 59.2, 59.3, 7.1, 12.1, 13.1, 15, 22, 23, 25, 26, 160),
}


@dataclass(frozen=True, slots=True)
class Dialect:
    """In what the languages of ISO 6983 differ.

    Attributes
    ----------
    title : str
        For messages.
    radius : str
        Word of an arc's radius.
    turns : str
        Word of an arc's turns; empty for none.
    more_turns : int
        What its value lacks to the number of turns, one for an arc of a circle at most.
    feed_counts, dwell_p : str
        As those of `Reading`, by default.
    ends : tuple of int
        Words M that end a program.
    also_ends : str
        What else does, for messages.
    harmless : frozenset of float
        Words G beside `HARMLESS` that move nothing.
    """

    title: str
    radius: str = "R"
    turns: str = ""
    more_turns: int = 0
    feed_counts: str = "linear"
    dwell_p: str = "s"
    ends: tuple[int, ...] = (2, 30)
    also_ends: str = ""
    harmless: frozenset[float] = frozenset()


@dataclass(slots=True)
class Modal:
    """A program that is being read: the modal state, and the blocks so far."""

    source: str
    dialect: Dialect
    reading: Reading
    packing: Packing = field(default_factory=Packing)
    lines: array[int] = field(default_factory=lambda: array("q"))
    left_out: Counter[str] = field(default_factory=Counter)
    at: list[float] = field(default_factory=lambda: list(_NOWHERE))
    motion: int = -1
    plane: int = 0
    incremental: bool = False
    centre_absolute: bool = False
    feed_mode: int = 94
    feed: float = nan
    ended: bool = False
    number: int = 0

    def fail(self, why: str) -> FormatError:
        """An error at the line that is being read."""
        return FormatError(f"{self.source}, line {self.number}: {why}")

    def comment(self, text: str) -> None:
        """Keep a line for people."""
        self.packing.other(Comment(text))
        self.lines.append(self.number)

    def stop(self, message: str = "") -> None:
        """Keep a programmed stop."""
        self.packing.other(Stop(message))
        self.lines.append(self.number)

    def dwell(self, seconds: float) -> None:
        """Keep a dwell."""
        if not 0 <= seconds < 1e6:
            raise self.fail(f"a dwell of {seconds:g} s; give 0 to 1000000 s")
        self.packing.other(Dwell(seconds))
        self.lines.append(self.number)

    def block(self, codes: list[float], words: dict[str, float], modes: Mapping[str, bool] | None = None) -> None:
        """Do what the words of one block say.

        Parameters
        ----------
        codes : list of float
            Its words G.
        words : dict of str to float
            All others but M, in the units of the file.
        modes : mapping of str to bool, optional
            Words that are absolute (False) or incremental (True) by themselves, whatever the mode.
        """
        machine_coordinates = False
        for code in codes:
            if code in _MOTIONS:
                self.motion = int(code)
            elif code in _PLANES:
                self.plane = _PLANES[int(code)]
            elif code == 90 or code == 91:
                self.incremental = code == 91
            elif code == 90.1:
                self.centre_absolute = True
            elif code == 91.1:
                self.centre_absolute = False
            elif code == 93 or code == 94:
                self.feed_mode, self.feed = int(code), self.feed if code == self.feed_mode else nan
            elif code == 4:
                self._dwell(words)
                return
            elif code in (28, 30, 53, 10):
                machine_coordinates = True
            elif code == 80:
                self.motion = -1
            elif code in REFUSED:
                raise self.fail(f"G{code:g} {REFUSED[code]}")
            elif code in PARAMETERS:
                for word in PARAMETERS[code]:
                    words.pop(word, None)
            elif code not in HARMLESS and code not in self.dialect.harmless:
                raise self.fail(f"G{code:g} is not known to {self.dialect.title}; take it out, or name another flavour")
        if "F" in words:
            self._set_feed(words.pop("F"))
        if not words:
            return
        if machine_coordinates:
            self.left_out["moves in machine coordinates (G28, G30, G53)"] += 1
            for word in words:
                if word in _COLUMN:
                    self.at[_COLUMN[word]] = nan
            return
        self._move(words, modes or {})

    def program(self, name: str) -> Program:
        """What was read.

        Raises
        ------
        FormatError
            If it does not end, or has no block.
        """
        if not self.ended:
            ends = " or ".join(f"M{number}" for number in self.dialect.ends) + self.dialect.also_ends
            raise self.fail(f"the program ends here without {ends}; it may be cut off: copy it again")
        if not len(self.packing):
            raise FormatError(f"{self.source}: the program has no block; look into the file")
        most = self.left_out.most_common(12)
        notes = [f"{what} ({count} times)" if count > 1 else what for what, count in most]
        said = (f"left out: {', '.join(notes)}",) if notes else ()
        return Program(name, self.packing.packed(), np.array(self.lines, dtype=np.intp), said)

    def _dwell(self, words: dict[str, float]) -> None:
        unit = self.reading.dwell_p or self.dialect.dwell_p
        if "P" in words:
            self.dwell(words["P"] / (1000.0 if unit == "ms" else 1.0))
        elif "X" in words or "U" in words:
            self.dwell(words.get("X", words.get("U", 0.0)))
        elif "F" in words:
            self.dwell(words["F"])
        else:
            raise self.fail("G4 without a time; give it as P, X or F as the control takes it")

    def _set_feed(self, value: float) -> None:
        if not value > 0:
            raise self.fail(f"the feed is {value:g}; it must be positive")
        self.feed = value

    def _move(self, words: dict[str, float], modes: Mapping[str, bool]) -> None:
        to, moved = list(_NOWHERE), False
        start = self.at
        end = list(start)
        for word in tuple(words):
            column = _COLUMN.get(word)
            if column is None:
                continue
            value = words.pop(word)
            if column >= LINEAR:
                value *= _RADIAN
            if modes.get(word, self.incremental) if modes else self.incremental:
                if start[column] != start[column]:
                    raise self.fail(f"{word} goes on from a place that is not known; give an absolute position first (G90)")
                value += start[column]
            to[column] = end[column] = value
            moved = True
        if self.motion >= 2:
            self._arc(words, modes, start, end, to)
        elif moved:
            if self.motion == 1:
                self.packing.line(to, self._line_feed(start, end))
            elif self.motion == 0:
                self.packing.rapid(to)
            else:
                raise self.fail("a position without G0, G1, G2 or G3; say how to go there")
            self.lines.append(self.number)
        if words:
            word, value = next(iter(words.items()))
            raise self.fail(f"the word {word}{value:g} is not known here; take it out, or name another flavour")
        self.at = end

    def _line_feed(self, start: list[float], end: list[float]) -> float:
        """Feed of a line as a program has it: along the linear axes, or the rotary ones where these alone move."""
        feed = self.feed
        if feed != feed:
            raise self.fail("a move at a feed that was never given; write F")
        turning = start[LINEAR:] != end[LINEAR:]
        if self.feed_mode == 94 and not turning:
            return feed / 60.0
        linear = _distance(start[:LINEAR], end[:LINEAR])
        rotary = _distance(start[LINEAR:], end[LINEAR:])
        if self.feed_mode == 93:
            self.feed = nan  # every block says its own
            return (linear or rotary or 1.0) * feed / 60.0
        counts = self.reading.feed_counts or self.dialect.feed_counts
        if not linear:
            return feed * _RADIAN / 60.0
        return feed / 60.0 * (linear / hypot(linear, rotary / _RADIAN) if counts == "all" else 1.0)

    def _arc(
        self, words: dict[str, float], modes: Mapping[str, bool], start: list[float], end: list[float], to: list[float]
    ) -> None:
        first, second = _FIRST_SECOND[self.plane]
        sense = 1 if self.motion == 3 else -1
        a, b = start[first], start[second]
        if a != a or b != b:
            raise self.fail("an arc from a place that is not known; go to its start first")
        if self.dialect.radius in words:
            centre = self._centre_of_radius(words.pop(self.dialect.radius), (a, b), (end[first], end[second]), sense)
        else:
            centre = self._centre(words, modes, (first, second), (a, b))
        begin, finish = hypot(a - centre[0], b - centre[1]), hypot(end[first] - centre[0], end[second] - centre[1])
        if not begin > 0:
            raise self.fail("an arc of radius zero; its centre is its start")
        if abs(finish - begin) > self.reading.radius_tolerance:
            raise self.fail(
                f"the arc does not close: its start is {begin:.6g} mm from the centre, its end {finish:.6g} mm, which "
                f"differ by more than {self.reading.radius_tolerance:g} mm; correct the end or the centre"
            )
        turns = words.pop(self.dialect.turns, None) if self.dialect.turns else None
        count = 1 if turns is None else int(turns) + self.dialect.more_turns
        if turns is not None and (turns != int(turns) or not 1 <= count < 1000):
            raise self.fail(f"the arc has {self.dialect.turns} = {turns:g}; give a whole number of turns up to 999")
        feed = self._arc_feed(start, end, begin, centre, sense, count)
        self.packing.arc(self.plane, to, centre, sense * count, feed)
        self.lines.append(self.number)

    def _centre(
        self, words: dict[str, float], modes: Mapping[str, bool], columns: tuple[int, int], start: tuple[float, float]
    ) -> tuple[float, float]:
        given = [words.pop(_CENTRE_WORDS[column], None) for column in columns]
        if given == [None, None]:
            needed = " or ".join(_CENTRE_WORDS[column] for column in columns)
            raise self.fail(f"an arc without a centre or radius; give {needed}, or {self.dialect.radius}")
        centre = []
        for k, column in enumerate(columns):
            value = given[k]
            absolute = not modes.get(_CENTRE_WORDS[column], True) if modes else False
            if absolute or self.centre_absolute:
                centre.append(start[k] if value is None else value)
            else:
                centre.append(start[k] + (value or 0.0))
        return centre[0], centre[1]

    def _centre_of_radius(
        self, radius: float, start: tuple[float, float], end: tuple[float, float], sense: int
    ) -> tuple[float, float]:
        dx, dy = end[0] - start[0], end[1] - start[1]
        chord = hypot(dx, dy)
        if not chord > 0:
            raise self.fail("a full circle by its radius has no centre; give the centre (I, J, K)")
        if not radius:
            raise self.fail("an arc of radius zero")
        rest = radius**2 - chord**2 / 4
        if rest < 0 and chord / 2 - abs(radius) > self.reading.radius_tolerance:
            raise self.fail(
                f"the arc does not close: its ends are {chord:.6g} mm apart, more than twice its radius of "
                f"{abs(radius):.6g} mm; correct one of them"
            )
        side = sense * (1.0 if radius > 0 else -1.0) * sqrt(max(rest, 0.0)) / chord
        return (start[0] + end[0]) / 2 - side * dy, (start[1] + end[1]) / 2 + side * dx

    def _arc_feed(
        self, start: list[float], end: list[float], radius: float, centre: tuple[float, float], sense: int, count: int
    ) -> float:
        if self.feed_mode == 94 and self.feed == self.feed:
            return self.feed / 60.0
        if self.feed != self.feed:
            raise self.fail("a move at a feed that was never given; write F")
        first, second = _FIRST_SECOND[self.plane]
        begin = np.arctan2(start[second] - centre[1], start[first] - centre[0])
        finish = np.arctan2(end[second] - centre[1], end[first] - centre[0])
        angle = float((finish - begin) * sense % (2 * np.pi)) or 2 * np.pi
        others = [k for k in range(LINEAR) if k not in (first, second)]
        rise = _distance([start[k] for k in others], [end[k] for k in others])
        length = hypot(radius * (angle + 2 * np.pi * (count - 1)), rise)
        feed, self.feed = self.feed, nan
        return length * feed / 60.0


def _distance(start: list[float], end: list[float]) -> float:
    """Between two places, where both are known."""
    return sqrt(sum((e - s) ** 2 for s, e in zip(start, end, strict=True) if s == s and e == e))
