"""Heidenhain Klartext, read: lines, circles about a pole (CC, C, CP) or by radius (CR), dwells, stops."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import atan2, cos, hypot, pi, radians, sin

from elastogeo.formats.program_files import Reading
from elastogeo.formats.programs.iso_text import SHOWN, program_lines
from elastogeo.formats.programs.modal import Dialect, Modal
from elastogeo.machine import Program

DIALECT = Dialect("Heidenhain", radius="CR", turns="TURN", more_turns=0, feed_counts="all", also_ends=", or END PGM")
_BEGIN = re.compile(r"BEGIN PGM (\S+) (MM|INCH)")
_END = re.compile(r"END PGM\b")
_WORD = re.compile(r"(IPA|PA|IPR|PR|I?[XYZABCUVW])([-+]?(?:\d+\.?\d*|\.\d+))(?=[ ]|$)", re.ASCII)
_OTHER = re.compile(
    r"(?P<way>DR[+-])|(?P<side>R[0LR])|(?P<radius>R[-+]?(?:\d+\.?\d*|\.\d+))|(?P<max>FMAX)|(?P<feed>F\d+\.?\d*)|(?P<m>M\d+)",
    re.ASCII,
)
_PATHS = {"L": 1, "C": 2, "CP": 2, "CR": 2, "CC": -1}
_DWELL = re.compile(r"CYCL DEF 9\.1\s+\D*\s*([\d.]+)$|FUNCTION DWELL TIME\s*([\d.]+)$")
_SILENT = re.compile(
    r"BLK FORM|TOOL (DEF|CALL)|LBL\b|CYCL DEF (9\.0|32\.\d|247)|PLANE RESET|FUNCTION (RESET TCPM|MODE)|Q\d+\s*=|\*|PRESET"
)
_REFUSED = {
    r"CALL (LBL|PGM)|SEL PGM": "calls another program or a part of this one; post-process plain blocks",
    r"CYCL (DEF|CALL)": "is a cycle; post-process plain blocks",
    r"FN\d*|QS?\d|QL\d": "computes; post-process plain numbers",
    r"PLANE|FUNCTION|TRANS": "transforms positions; post-process axis positions",
    r"TCH PROBE": "probes, and where it stops is not known",
    r"(APPR|DEP|RND|CHF|CT|F[LCP]\b|LP)": "is a contour that is not followed here; post-process plain L, C, CP, CR blocks",
}
_TRANSFORMED = {128: "gives tool tips for the control to transform", 118: "adds the handwheel", 97: "leaves corners out"}
_AT_MACHINE = {91, 92}


def read_klartext(data: bytes, source: str, reading: Reading) -> Program:
    """A program in Klartext; the tool axis is Z, circles lie in XY.

    Raises
    ------
    FormatError
        At the first line that cannot be followed.
    """
    modal = Modal(source, DIALECT, reading)
    pole: list[float] = [float("nan")] * 2
    name, open_cycle = "", False
    for at, text, comment in _blocks(data, source, modal):
        modal.number = at
        begin = _BEGIN.match(text)
        if begin:
            name = begin[1]
            if begin[2] == "INCH":
                raise modal.fail("the program is in inches; post-process it in millimetres")
            continue
        if not name:
            raise modal.fail(f"{text[:SHOWN]!r} stands before BEGIN PGM; a Klartext program begins with it")
        if _END.match(text):
            modal.ended = True
            break
        if not text:
            modal.comment(comment)
            continue
        continued, open_cycle = open_cycle, text.endswith("~")
        if not continued:
            _do(text, comment, modal, pole)
    return modal.program(name or source)


def _blocks(data: bytes, source: str, modal: Modal) -> Iterator[tuple[int, str, str]]:
    """Number of the line, block without its own number, comment."""
    for at, line in program_lines(data, source):
        modal.number = at
        text, _, comment = line.partition(";")
        text = " ".join(re.sub(r"^\s*\d+(?=\s|$)", "", text).split())
        if text or comment.strip():
            yield at, text, comment.strip()


def _do(text: str, comment: str, modal: Modal, pole: list[float]) -> None:
    """What a block says."""
    text = text.upper()
    dwell = _DWELL.match(text)
    if dwell:
        modal.dwell(float(dwell[1] or dwell[2]))
    elif text.split()[0] in _PATHS:
        _path(text, modal, pole)
    elif re.match(r"(STOP|M0?[01])\b", text):
        modal.stop(comment)
    elif re.match(r"M(2|30|02)\b", text):
        modal.ended = True
    elif re.fullmatch(r"(M\d+ ?)+", text):
        for function in re.findall(r"\d+", text):
            _function(int(function), modal)
    elif _SILENT.match(text):
        modal.left_out[" ".join(text.split()[:2]).partition("=")[0][:SHOWN]] += 1
    else:
        why = next((why for pattern, why in _REFUSED.items() if re.match(pattern, text)), "is not known in Klartext here")
        raise modal.fail(f"{text[:SHOWN]!r} {why}")


def _path(text: str, modal: Modal, pole: list[float]) -> None:
    """A line, a circle, or the pole of circles."""
    head, _, rest = text.partition(" ")
    words, modes, others = _words(rest, modal)
    if head == "CC":
        _set_pole(words, modes, modal, pole)
        return
    functions = [int(word[1:]) for word in others.get("m", [])]
    if "side" in others and others["side"][-1] != "R0":
        raise modal.fail("RL and RR correct for the cutter's radius; post-process the path of the centre")
    for function in functions:
        _function(function, modal)
    if "feed" in others:
        words["F"] = float(others["feed"][0][1:])
    codes: list[float] = [0.0] if "max" in others else [1.0]
    if head != "L":
        way = others.get("way", [""])[0]
        if not way:
            raise modal.fail("a circle without its sense; write DR+ or DR-")
        codes = [17.0, 3.0 if way == "DR+" else 2.0]
        _circle(head, words, modes, others, modal, pole)
    if _AT_MACHINE & set(functions):
        codes.append(53.0)
    if set(words) - {"F"}:
        modal.block(codes, words, modes)
    elif "F" in words:
        modal.block([], words)
    if {0, 1} & set(functions):
        modal.stop()
    modal.ended = modal.ended or bool({2, 30} & set(functions))


def _circle(
    head: str,
    words: dict[str, float],
    modes: dict[str, bool],
    others: dict[str, list[str]],
    modal: Modal,
    pole: list[float],
) -> None:
    """Give a circle the words that the modal state takes: its centre, or its radius."""
    if head == "CR":
        if "radius" not in others:
            raise modal.fail("CR without a radius; write R+ or R-")
        words["CR"] = float(others["radius"][0][1:])
        return
    if pole[0] != pole[0] or pole[1] != pole[1]:
        raise modal.fail("a circle without a pole; write CC first")
    if head == "CP":
        _polar(words, modes, others["way"][0] == "DR+", modal, pole)
    elif not {"X", "Y"} & set(words):
        raise modal.fail("a circle out of the plane XY, whose sense is not public; write it as lines, or as C X Y")
    words |= {"I": pole[0], "J": pole[1]}
    modes |= {"I": False, "J": False}


def _polar(words: dict[str, float], modes: dict[str, bool], counter: bool, modal: Modal, pole: list[float]) -> None:
    """The end of a circle that is given by an angle about the pole."""
    x, y = modal.at[0], modal.at[1]
    begin, radius = atan2(y - pole[1], x - pole[0]), hypot(x - pole[0], y - pole[1])
    if "IPA" in words:
        angle = radians(words.pop("IPA"))
        if angle and (angle > 0) != counter:
            raise modal.fail("IPA and DR have different signs; make them the same")
    elif "PA" in words:
        angle = radians(words.pop("PA")) - begin
        angle = angle % (2 * pi) if counter else -(-angle % (2 * pi))
    else:
        raise modal.fail("CP without an angle; write PA or IPA")
    if not angle:
        raise modal.fail("a circle of no angle; write IPA+360 for a full one")
    whole = abs(angle) / (2 * pi)
    turns = round(whole) if abs(whole - round(whole)) < 1e-9 and round(whole) else int(whole) + 1
    closed = abs(whole - round(whole)) < 1e-9
    end = (x, y) if closed else (pole[0] + radius * cos(begin + angle), pole[1] + radius * sin(begin + angle))
    words |= {"X": end[0], "Y": end[1], "TURN": float(turns)}
    modes |= {"X": False, "Y": False}


def _set_pole(words: dict[str, float], modes: dict[str, bool], modal: Modal, pole: list[float]) -> None:
    if set(words) - {"X", "Y"}:
        raise modal.fail("a pole out of the plane XY, about which the sense of a circle is not public; write lines")
    if not words:
        pole[:] = modal.at[:2]
    for k, axis in enumerate("XY"):
        if axis in words:
            pole[k] = words[axis] + (modal.at[k] if modes.get(axis) else 0.0)


def _words(rest: str, modal: Modal) -> tuple[dict[str, float], dict[str, bool], dict[str, list[str]]]:
    """Positions, which of them are incremental, and all other words of a path block by their kind."""
    words: dict[str, float] = {}
    modes: dict[str, bool] = {}
    others: dict[str, list[str]] = {}
    for word in rest.split():
        found = _WORD.fullmatch(word)
        if found:
            polar = found[1] in ("IPA", "PA", "PR", "IPR")
            name = found[1] if polar else found[1].removeprefix("I")
            if name in words:
                raise modal.fail(f"the word {name} stands twice in one block; take one out")
            words[name] = float(found[2])
            if not polar:
                modes[name] = found[1].startswith("I")
            continue
        other = _OTHER.fullmatch(word)
        if other is None:
            computed = "Q" in word
            why = "variables are not computed; post-process plain numbers" if computed else "write words such as X+1.5"
            raise modal.fail(f"{word[:SHOWN]!r} is not understood: {why}")
        others.setdefault(str(other.lastgroup), []).append(word)
    return words, modes, others


def _function(function: int, modal: Modal) -> None:
    if function in _TRANSFORMED:
        raise modal.fail(f"M{function} {_TRANSFORMED[function]}; post-process axis positions")
    if function not in (0, 1, 2, 30, *_AT_MACHINE):
        modal.left_out[f"M{function}"] += 1
