"""LinuxCNC's own interpreter of part programs, `rs274`: what a program makes a machine do, by canonical moves."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from tests.linuxcnc.unpacked import environment, unpacked

_CALL = re.compile(r"([A-Z_]+)\((.*)\)\s*$")
_MOVES = {"STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED", "DWELL"}
_SETTINGS = "[RS274NGC]\n[TRAJ]\nLINEAR_UNITS=mm\nANGULAR_UNITS=degree\n"
_TOOLS = "T1 P1 Z0 D0 ;\n"


class RefusedError(Exception):
    """What the interpreter says of a program that it does not take."""


@dataclass(frozen=True)
class Canonical:
    """One canonical move, in mm and degrees, with the plane and the feed at work: along the linear axes
    in mm/min, also where the program gives it in inverse time.

    `STRAIGHT_TRAVERSE` and `STRAIGHT_FEED` have the values x y z a b c; `ARC_FEED` the ends and the centre along the first
    and second axis of its plane, the turns (negative clockwise), the end along the third axis, a b c; `DWELL` the seconds.
    """

    kind: str
    values: tuple[float, ...]
    plane: str
    feed: float


def interpret(text: str, folder: Path) -> list[Canonical]:
    """The canonical moves of a program, four decimals each.

    Raises
    ------
    RefusedError
        With the interpreter's own message.
    """
    files = {"machine.ini": _SETTINGS, "tools.tbl": _TOOLS, "variables.var": "", "program.ngc": text}
    for name, content in files.items():
        (folder / name).write_text(content, encoding="ascii")
    root = unpacked()
    command = [str(root / "usr/bin/rs274"), "-i", "machine.ini", "-t", "tools.tbl", "-v", "variables.var", "-g"]
    done = subprocess.run(
        [*command, "program.ngc"], cwd=folder, env=environment(root, folder), capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RefusedError(f"{done.stderr.strip() or 'no message'} (after {done.stdout.strip().splitlines()[-1:]})")
    return _moves(done.stdout)


def _moves(printed: str) -> list[Canonical]:
    plane, feed, found = "XY", 0.0, []
    for line in printed.splitlines():
        call = _CALL.search(line)
        if call is None:
            continue
        name, given = call[1], call[2]
        if name == "SELECT_PLANE":
            plane = {"XY": "XY", "YZ": "YZ", "XZ": "ZX"}[given.removeprefix("CANON_PLANE_")]
        elif name == "SET_FEED_RATE":
            feed = float(given)
        elif name in _MOVES:
            found.append(Canonical(name, tuple(map(float, given.split(","))), plane, feed))
    return found
