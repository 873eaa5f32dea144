"""Planned tests as folders to fill: a campaign file, and for each test its file with the set-up and the runs to make."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.documents.campaigns import FILE_NAME as CAMPAIGN
from elastogeo.formats.documents.campaigns import SCHEMA as CAMPAIGN_SCHEMA
from elastogeo.formats.documents.machine_tests import FILE_NAME as TEST
from elastogeo.formats.documents.machine_tests import SCHEMA as TEST_SCHEMA
from elastogeo.formats.documents.templates import machine_named_from
from elastogeo.formats.text.toml_documents import unit_of
from elastogeo.formats.text.whole_files import write_whole
from elastogeo.machine import LINEAR, MM_OR_RAD
from elastogeo.observe import Campaign, MachineTest, Run

_PER_MINUTE, _PER_DEGREE = 60.0, 180.0 / np.pi
_WRITTEN = {"mm_s": ("mm_min", _PER_MINUTE), "rad": ("deg", _PER_DEGREE)}
"""Units in which people write what is in others inside."""


def write_tests(campaign: Campaign, folder: str | Path, machine: str) -> tuple[Path, ...]:
    """Write planned tests as a folder of a campaign; the run files that they name are to be measured.

    Parameters
    ----------
    campaign : Campaign
        Of planned tests.
    folder : str or Path
        It must not exist.
    machine : str
        A shipped machine, or the path of its machine file.

    Returns
    -------
    tuple of Path
        The campaign file, then the test files.

    Raises
    ------
    FormatError
        If the folder exists.
    """
    folder = Path(folder)
    if folder.exists():
        raise FormatError(f"{folder} is there already; choose another name, nothing was changed")
    written = {folder / CAMPAIGN: _campaign_text(campaign, machine_named_from(machine, folder))}
    for name, test in campaign.tests.items():
        written[folder / name / TEST] = test_text(test, machine_named_from(machine, folder / name))
    return write_whole({path: text.encode() for path, text in written.items()})


def test_text(test: MachineTest, machine: str) -> str:
    """A planned test as the text of its file.

    Parameters
    ----------
    test : MachineTest
    machine : str
        As the file is to name it.
    """
    lines = [
        f'schema = "{TEST_SCHEMA}"',
        f"name = {_text(test.name)}",
        f"machine = {_text(machine)}",
        f'instrument = "{test.instrument}"',
        "",
        *_tables(test.setup, "setup"),
    ]
    for run in test.runs:
        lines += ["", *_run_lines(run)]
    return "\n".join(lines) + "\n"


def _campaign_text(campaign: Campaign, machine: str) -> str:
    names = ", ".join(map(_text, campaign.tests))
    turning = any(joint.is_rotary and joint.compliant for joint in campaign.machine.joints)
    question = ", ".join(map(_text, ("compliance", f"geometry-{5 if turning else 3}-axis")))
    return (
        f'schema = "{CAMPAIGN_SCHEMA}"\nname = {_text(campaign.name)}\nmachine = {_text(machine)}\ntests = [{names}]\n\n'
        f"# What does not go with the force is geometry: it is asked for too, so that it is not taken for compliance.\n"
        f"[question]\nparameters = [{question}]\n"
    )


def _run_lines(run: Run) -> Iterator[str]:
    yield "[[runs]]"
    yield f'file = "runs/{run.name.replace(" ", "")}.csv"'
    levels = (("force_N", run.force), ("pressure_bar", run.pressure), ("engagement_mm", run.engagement))
    yield from (f"{key} = {level:.12g}" for key, level in levels if level is not None)
    if run.sense < 0:
        yield 'sense = "cw"'


def _tables(table: Any, name: str) -> Iterator[str]:
    """A dataclass as a table of a document, with what differs from its defaults; its own tables after its keys."""
    inner: list[str] = []
    yield f"[{name}]"
    for key, value, unit in _entries(table):
        if is_dataclass(value):
            inner += ["", *_tables(value, f"{name}.{key}")]
        elif isinstance(value, tuple) and value and all(map(is_dataclass, value)):
            for one in value:
                head, *rest = _tables(one, f"{name}.{key}")
                inner += ["", f"[{head}]", *rest]
        else:
            spelled, factor = _WRITTEN.get(unit, (unit, 1.0))
            yield f"{key}{f'_{spelled}' if spelled and unit != MM_OR_RAD else ''} = {_value(value, unit, factor)}"
    yield from inner


def _entries(table: Any) -> Iterator[tuple[str, Any, str]]:
    hints = get_type_hints(type(table), include_extras=True)
    for field in fields(table):
        value = getattr(table, field.name)
        default = field.default_factory() if field.default_factory is not MISSING else field.default
        if value is not None and (default is MISSING or value != default):
            yield field.name, value, unit_of(hints[field.name])


def _value(value: Any, unit: str, factor: float) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_command(axis, one, unit) for axis, one in value.items()) + " }"
    if isinstance(value, tuple):
        return "[" + ", ".join(_value(one, unit, factor) for one in value) + "]"
    return repr(float(value) * factor)


def _command(axis: str, value: Any, unit: str) -> str:
    """A command by axis, in mm or degrees; without a unit as it is."""
    if unit != MM_OR_RAD:
        return f"{axis} = {_value(value, '', 1.0)}"
    kind, factor = ("mm", 1.0) if axis in LINEAR else ("deg", _PER_DEGREE)
    return f"{axis}_{kind} = {_value(value, '', factor)}"


def _text(words: str) -> str:
    escaped = words.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
