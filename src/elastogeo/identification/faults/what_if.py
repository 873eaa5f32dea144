"""What if a fault were corrected? The trace and its circular deviation without the part that named parameters cause."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Unpack

import numpy as np

from elastogeo.errors import SelectionError
from elastogeo.identification.faults.circularity import Circularity
from elastogeo.identification.faults.diagnosis import level_circularity
from elastogeo.identification.identification import identified
from elastogeo.identification.question import Asked, systems_of
from elastogeo.identification.result import Identification, Trace
from elastogeo.observe import MachineTest
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class WhatIf(Result):
    """A test without some of its faults.

    Attributes
    ----------
    identification : Identification
        That it rests on.
    corrected : tuple of str
        Parameters whose part is subtracted.
    traces : tuple of Trace
        What would be measured, with what would be predicted.
    before, after : dict of float to Circularity
        ISO 230-4 parameters by force level [N].
    peak_to_peak : dict of str to tuple of 2 float [mm]
        Of each run's trace, before and after.
    """

    identification: Identification
    corrected: tuple[str, ...]
    traces: tuple[Trace, ...]
    before: dict[float, Circularity]
    after: dict[float, Circularity]
    peak_to_peak: dict[str, tuple[float, float]]


def what_if(one: MachineTest | Identification, correct: str | Sequence[str], **asked: Unpack[Asked]) -> WhatIf:
    """Predict the traces with the faults of some parameters corrected.

    Parameters
    ----------
    one : MachineTest or Identification
        A test, or what it says already.
    correct : str or sequence of str
        Names or shell patterns of identified parameters.
    **asked
        Of a test, another question than its own, as in `with_question`.

    Raises
    ------
    SelectionError
        If a pattern names no identified parameter. A parameter that cannot be told from others is corrected with them, under
        the name of the retained one.
    """
    result = identified(one, **asked)
    patterns = (correct,) if isinstance(correct, str) else tuple(correct)
    known = [parameter.name for parameter in result.parameters]
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in known):
            raise SelectionError(f"{pattern!r} is none of the identified parameters: {', '.join(known)}")
    corrected = tuple(name for name in known if any(fnmatchcase(name, pattern) for pattern in patterns))
    values = np.array([parameter.value for parameter in result.parameters if parameter.name in corrected])
    runs = {run.name: run for run in systems_of(result.test).runs}
    traces = []
    for trace in result.traces:
        part = runs[trace.run].design_of(corrected) @ values
        traces.append(Trace(trace.run, trace.force, trace.pose, trace.measured - part, trace.predicted - part))
    spans = zip(result.traces, traces, strict=True)
    return WhatIf(
        identification=result,
        corrected=corrected,
        traces=tuple(traces),
        before=level_circularity(result),
        after=level_circularity(result, traces),
        peak_to_peak={old.run: (float(np.ptp(old.measured)), float(np.ptp(new.measured))) for old, new in spans},
    )
