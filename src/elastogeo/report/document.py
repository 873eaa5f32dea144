"""What all documents share: the schema and the software first, then plain types only.

schema : its name and number
software : {name, version}
test : {name, machine, topology, instrument, simulated, reference_force_N, resolution_um, runs, about, files}
    `simulated` says from what the readings are simulated and is empty if they were measured; `reference_force_N` is the
    level that is subtracted, or null; `runs` counts the runs of the test, the reference among them; `about` holds what the
    test says of date, operator, place and serial numbers; `files` the files that were read, each with its SHA-256 and
    what it says of the simulation that made it: [{run, file, sha256, simulated}].
verdict : [{name, passed, sentence, decisive}]
    If a decisive check fails, the data do not support what was asked.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isfinite
from typing import Any

import numpy as np

from elastogeo.estimate import Estimate
from elastogeo.identification import Check
from elastogeo.observe import Campaign, MachineTest
from elastogeo.report.sentences import sentence_of
from elastogeo.version import VERSION

UM = 1000.0
"""Micrometres in a millimetre."""


def document(schema: str, entries: Mapping[str, Any]) -> dict[str, Any]:
    """A document of this schema, with plain JSON types only."""
    whole = {"schema": schema, "software": {"name": "elastogeo", "version": VERSION}, **entries}
    return {key: _plain(value) for key, value in whole.items()}


def tested(test: MachineTest, reference_force: float | None) -> dict[str, Any]:
    """What was tested."""
    return {
        "name": test.name,
        "machine": test.machine.name,
        "topology": test.machine.topology.compact,
        "instrument": test.instrument,
        "simulated": test.simulated,
        "reference_force_N": reference_force,
        "resolution_um": None if test.setup.reads_angles else in_um(test.resolution),
        "runs": len(test.runs),
        "about": test.about.said(),
        "files": [
            {"run": run.name, "file": run.file, "sha256": run.sha256, "simulated": run.simulated}
            for run in test.runs
            if run.sha256
        ],
    }


def tested_together(campaign: Campaign, reference_force: float | None) -> dict[str, Any]:
    """What was tested: of several tests what they have in common, with the files of all."""
    if not campaign.several:
        return tested(campaign.only, reference_force)
    each = {name: tested(test, None) for name, test in campaign.tests.items()}
    return {
        "name": campaign.name,
        "machine": campaign.machine.name,
        "topology": campaign.machine.topology.compact,
        "instrument": ", ".join(dict.fromkeys(entry["instrument"] for entry in each.values())),
        "simulated": campaign.simulated,
        "reference_force_N": None,
        "resolution_um": None,
        "runs": campaign.runs,
        "about": {},
        "files": [{**file, "run": f"{name}/{file['run']}"} for name, entry in each.items() for file in entry["files"]],
    }


def verdict_entries(checks: Iterable[Check]) -> list[dict[str, Any]]:
    """Named checks."""
    return [{"name": c.name, "passed": c.passed, "sentence": sentence_of(c), "decisive": c.decisive} for c in checks]


def uncertainty_entries(found: Estimate | None, factor: float = 1.0) -> dict[str, Any]:
    """How uncertain a value is, in its own unit times a factor; null where it is not known."""
    known = found if found is not None and found.known else None
    return {
        "standard_uncertainty": None if known is None else known.standard_uncertainty * factor,
        "interval95": None if known is None else [bound * factor for bound in known.interval()],
        "degrees_of_freedom": None if known is None else known.degrees_of_freedom,
    }


def in_um(length: float | None) -> float | None:
    """A length [mm] in micrometres; none for none."""
    return None if length is None else length * UM


_AS_IT_IS = frozenset((str, int, bool, type(None)))


def _plain(value: Any) -> Any:
    """The same with plain JSON types only; a number that is not finite becomes null. The commonest kinds come first."""
    kind = type(value)
    if kind is float:
        return value if isfinite(value) else None
    if kind in _AS_IT_IS:
        return value
    if kind is dict or isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
