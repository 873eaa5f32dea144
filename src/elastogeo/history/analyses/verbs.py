"""Which verb answers a test: told by the result that its instrument says it has besides parameters (`Setup.extra`).

A new kind of result is one line here; an instrument that has none of its own is identified.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from elastogeo.errors import FormatError
from elastogeo.formats import read_drives, read_test
from elastogeo.identification import (
    diagnose,
    evaluate_positioning,
    evaluate_static,
    identify,
    identify_drives,
    map_stiffness,
)
from elastogeo.observe import MachineTest
from elastogeo.result import Result

Answer = Callable[[MachineTest], Result]

SEED = 0
"""Where all that is drawn at random in an analysis begins."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A test that was read, with the verb that answers it.

    Attributes
    ----------
    verb : str
        As on the command line.
    question : mapping
        What is asked, as plain values.
    answer : callable
        Gives the result.
    """

    verb: str
    question: dict[str, Any]
    answer: Callable[[], Result]


def _circles(test: MachineTest) -> tuple[str, Answer]:
    return ("identify", identify) if test.setup.loads else ("diagnose", diagnose)


def _plain(_: MachineTest) -> tuple[str, Answer]:
    return "identify", identify


def _static(_: MachineTest) -> tuple[str, Answer]:
    return "static", evaluate_static


def _positioning(_: MachineTest) -> tuple[str, Answer]:
    return "positioning", evaluate_positioning


def _stiffness(_: MachineTest) -> tuple[str, Answer]:
    return "stiffness", map_stiffness


VERBS: dict[str, Callable[[MachineTest], tuple[str, Answer]]] = {
    "circularity": _circles,
    "positioning": _positioning,
    "stiffness-map": _stiffness,
    "loading-cycles": _static,
    "cartesian-stiffness": _static,
    "twist": _static,
}


def asked_of_test(file: Path) -> Asked:
    """A test and its verb, from its test file."""
    test = read_test(file)
    verb, answer = VERBS.get(test.setup.extra, _plain)(test)
    return Asked(verb, asdict(test.question), lambda: answer(test))


def asked_of_drives(file: Path) -> Asked:
    """Logs of feed drives and their verb, from their drive file."""
    test = read_drives([file])
    question = {"axes": test.axes, "held_out": test.held_out, "compare": test.compare, "models": dict(test.models)}
    return Asked("drive", question, lambda: identify_drives(test))


READERS = {"test.toml": asked_of_test, "drive.toml": asked_of_drives}
"""By the name of the file that says what was done."""


def asked_of(folder: Path, paths: list[str]) -> Asked:
    """What is asked of a test whose files lie in a folder.

    Raises
    ------
    FormatError
        If none of its files says what was done.
    InputError
        If the test cannot be read.
    """
    name = next((name for name in READERS if name in paths), None)
    if name is None:
        raise FormatError(f"this test has none of the files {', '.join(READERS)}; it holds {', '.join(paths) or 'nothing'}")
    return READERS[name](folder / name)
