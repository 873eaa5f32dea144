"""Machines that move alike with one instrument: then it is the instrument that changed, most likely, not they."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part

LEAST_MACHINES = 3
"""Machines that move alike before it is the instrument."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class InstrumentMove(Part):
    """Machines that moved to the same side, by the same amount within their scatter, with one instrument.

    Attributes
    ----------
    instrument : str
        Serial number.
    since : float [d]
        Of its last calibration or repair; the first test with it where none is known.
    machines : tuple of str
        Those that moved alike, at least three: their alarms are held back under this one.
    series : tuple of str
        Of each of them, the series that moved.
    indicators : tuple of str
        That moved.
    shifts : tuple of float
        Of each of these indicators the common change, in the unit of its kind.
    intervals : tuple of (float, float)
        Of each shift, 95 %.
    others : tuple of str
        Machines that were tested with it since then and did not move so.
    p_value : float
        Of the differences between the machines' changes, or greater ones, if all moved by the common change.
    """

    instrument: str
    since: float
    machines: tuple[str, ...]
    series: tuple[str, ...]
    indicators: tuple[str, ...]
    shifts: tuple[float, ...]
    intervals: tuple[tuple[float, float], ...]
    others: tuple[str, ...]
    p_value: float
