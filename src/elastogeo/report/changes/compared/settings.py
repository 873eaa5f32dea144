"""The settings by which two tests differ, in words."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any

from elastogeo.changes import ComparedTests, SettingDifference
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import listed
from elastogeo.report.view import Table

_NAMES = {
    "temperature_degC": "temperature of the machine [°C]",
    "instrument_serial": "instrument, serial number",
    "instrument_calibrated": "instrument, calibrated",
    "machine_serial": "machine, serial number",
    "setup.circle.radius": "radius [mm]",
    "setup.circle.feed": "feed [mm/s]",
    "runs.level": "levels",
    "runs.runs": "runs of a level",
    "runs.feed": "feed of the runs [mm/s]",
    "runs.sense": "directions",
    "runs.arc_deg": "arc [°]",
    "question.parameters": "parameters asked for",
    "software": "version of elastogeo",
    "topology": "topology of the machine",
    "workpiece": "workpiece",
    "origin": "measured or simulated",
}
_MOST = 120


def setting_name(name: str) -> str:
    """What a setting is called: `radius [mm]` for `setup.circle.radius`."""
    return _NAMES.get(name) or name.removeprefix("setup.").replace("question.", "asked: ").replace(".", ", ").replace(
        "_", " "
    )


def settings_table(result: ComparedTests) -> Table | None:
    """The settings that differ, those of the recipe first; none where none does."""
    if not result.settings:
        return None
    ordered = sorted(result.settings, key=lambda one: not one.in_recipe)
    rows = tuple((setting_name(one.name), _said(one.before), _said(one.after), _weight(one)) for one in ordered)
    return Table(
        ("setting", "before", "after", ""),
        rows,
        words=(0, 1, 2, 3),
        title="Settings that differ",
        note="Every other setting of the recipe is the same." if result.one_recipe else "",
        name="settings",
        strong=tuple(k for k, one in enumerate(ordered) if one.in_recipe),
    )


def _weight(one: SettingDifference) -> str:
    return "another recipe" if one.in_recipe else ""


def _said(value: Any) -> str:
    if value is None or value == "":
        return "not said"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        return pretty(f"{value:g}") if isfinite(value) else significant(value)
    if isinstance(value, Mapping):
        text = ", ".join(f"{key} {_said(one)}" for key, one in value.items())
    elif isinstance(value, list | tuple):
        text = listed(tuple(_said(one) for one in value)) if value else "none"
    else:
        text = str(value)
    return text if len(text) <= _MOST else f"{text[: _MOST - 1]}…"
