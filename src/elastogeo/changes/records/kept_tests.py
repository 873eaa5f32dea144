"""One test that a history keeps: what is known of it, its raw files, what was said of it, what it was evaluated to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from elastogeo.result import Result


@dataclass(frozen=True, slots=True)
class KeptFile:
    """One raw file: its path in the test's folder, the SHA-256 of its content, its size in bytes."""

    path: str
    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class KeptAnalysis:
    """What a version of the software said of a test.

    Attributes
    ----------
    key : int
    software : str
    made_at : float [d]
    supported : bool
        Whether the data support what was asked.
    error : str
        Why there is no document; empty if there is one.
    settings : dict
        The verb, the question, and what it was made with.
    inputs_sha256, document_sha256 : str
    document : dict or None
        That of the result's view.
    """

    key: int
    software: str
    made_at: float
    supported: bool
    error: str
    settings: dict[str, Any]
    inputs_sha256: str
    document_sha256: str
    document: dict[str, Any] | None


@dataclass(frozen=True, slots=True)
class SetAside:
    """A person set a test aside, or took it back: when [d], who, why."""

    aside: bool
    at: float
    who: str
    why: str


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptTest(Result):
    """A test of a history.

    Attributes
    ----------
    key : int
    name : str
    machine, series : str
    machine_key, series_key : int
    at, imported_at : float [d]
        When it was measured, and came in.
    zone : str
        In which the time is said: `+01:00`; empty for UTC.
    origin, from_what : str
        Measured, simulated or reconstructed; from what.
    temperature : float or None [degC]
    instrument, calibration : str
        Serial number of the instrument; the certificate that held when it was measured.
    calibrated_at, calibration_due : float or None [d]
    who : str
        Who imported it.
    about : dict
        What the test says of itself: operator, place, remarks.
    files : tuple of KeptFile
        In the order of their paths.
    asides : tuple of SetAside
        In the order in which they were said; the last one holds.
    analysis : KeptAnalysis or None
        By this version of the software if there is one, else the last one.
    counts_with : str
        The version with which its series counts.
    previous, following : int or None
        The tests of its series before and after it in time.
    baseline : int or None
        The last test of the series' baseline, if it is another one.
    repeats : int or None
        The suspect test that it repeats.
    """

    key: int
    name: str
    machine: str
    series: str
    machine_key: int
    series_key: int
    at: float
    imported_at: float
    zone: str
    origin: str
    from_what: str
    temperature: float | None
    instrument: str
    calibration: str
    calibrated_at: float | None
    calibration_due: float | None
    who: str
    about: dict[str, Any]
    files: tuple[KeptFile, ...]
    asides: tuple[SetAside, ...]
    analysis: KeptAnalysis | None
    counts_with: str
    previous: int | None
    following: int | None
    baseline: int | None
    repeats: int | None

    @property
    def is_aside(self) -> bool:
        """Whether it is set aside, so that it counts in no chart."""
        return bool(self.asides) and self.asides[-1].aside
