"""What all documents share: the schema and the software first, then plain types only.

schema : its name and number
software : {name, version}
test : {name, machine, topology, instrument, simulated, reference_force_N, resolution_um, runs}
    `simulated` says from what the readings are simulated and is empty if they were measured; `reference_force_N` is the
    level that was taken off, or null; `runs` counts the runs of the test, the reference among them.
verdict : [{name, passed, sentence, decisive}]
    If a decisive check fails, the data do not support what was asked.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isfinite
from typing import Any

import numpy as np

from elastogeo.identification import Check
from elastogeo.observe import MachineTest, instruments
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
        "instrument": instrument_name(test),
        "simulated": test.simulated,
        "reference_force_N": reference_force,
        "resolution_um": in_um(test.resolution),
        "runs": len(test.runs),
    }


def verdict_entries(checks: Iterable[Check]) -> list[dict[str, Any]]:
    """Named checks."""
    return [{"name": c.name, "passed": c.passed, "sentence": sentence_of(c), "decisive": c.decisive} for c in checks]


def instrument_name(test: MachineTest) -> str:
    """The name of a test's instrument: as test files spell it, else that of its class."""
    kind = type(test.setup)
    return next((name for name, known in instruments().items() if known is kind), kind.__name__)


def in_um(length: float | None) -> float | None:
    """A length [mm] in micrometres; none for none."""
    return None if length is None else length * UM


def _plain(value: Any) -> Any:
    """The same with plain JSON types only; a number that is not finite becomes null."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not isfinite(value):
        return None
    return value
