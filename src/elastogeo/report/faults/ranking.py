"""The ranked faults of a diagnosis as bars."""

from __future__ import annotations

from textwrap import fill

from matplotlib.figure import Figure

from elastogeo.identification import Diagnosis
from elastogeo.report.faults.rows import described, distortion_interval
from elastogeo.report.identification.figures.contributions import Bar, kind_of, ranked
from elastogeo.report.text import UM

_WORDS = 56


def ranking_figure(diagnosis: Diagnosis) -> Figure:
    """Distortion of the trace by each fault of the machine [µm], signed, greatest first; pale if it may be none."""
    result, bars = diagnosis.identification, []
    for fault in reversed([fault for fault in diagnosis.faults if fault.axis]):
        shown = described(fault, result)
        interval = distortion_interval(fault)
        low, high = (bound * UM for bound in interval or (fault.distortion, fault.distortion))
        kind = kind_of(result, [p for p in result.parameters if p.name in fault.names])
        name = fill(shown.meaning if shown.separated else shown.title, _WORDS)
        share = f" · {100 * fault.share:.1f} %"
        bars.append(Bar(name, fault.distortion * UM, low, high, share, kind, fault.significant or interval is None))
    return ranked(result, bars)
