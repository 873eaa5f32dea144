"""The view of a test that a history keeps: its state in one sentence, its checks, and where everything comes from.

`elastogeo.test/1` is the document of its analysis (`elastogeo.identification/1` or another, named `result`), and

kept : {key, name, machine, series, measured, imported, origin, simulated, instrument, calibration, calibrated, due, who,
    about, temperature_degC, previous, following, baseline, repeats}
files : [{number, path, sha256, bytes}]
set_aside : [{aside, at, who, why}], the last one holds
analysis : null, or {software, made_at, supported, error, settings, inputs_sha256, document_sha256}
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from elastogeo.changes import KeptAnalysis, KeptTest
from elastogeo.report.days import date_said, iso_date, moment_said, origin_said
from elastogeo.report.document import document
from elastogeo.report.text import listed
from elastogeo.report.view import Badge, Said, Section, Table, View, attention_sentence, views

SCHEMA = "elastogeo.test/1"
_KILO, _MEGA = 1000, 1_000_000
_ABOUT = {"operator": "Operator", "place": "Place", "remarks": "Remarks"}


@views(KeptTest)
def kept_test_view(test: KeptTest) -> View:
    """What is known of a test, and what its analysis says at once."""
    found = test.analysis
    checks = _checks(found)
    return View(
        kind="Test",
        title=f"Test of {date_said(test.at)}",
        subtitle=test.machine,
        origin=_origin(test),
        head=tuple(_head(test)),
        sentence=_answer(test, checks),
        checks=checks,
        document=_document(test),
        rows=[{"number": k, "path": file.path, "sha256": file.sha256} for k, file in enumerate(test.files, 1)],
        alert=tuple(_alerts(test)),
        badge=_badge(test, checks),
        sections=(Section("Where it comes from", tables=(files_table(test), provenance_table(test), asides_table(test))),),
    )


def files_table(test: KeptTest) -> Table:
    """The raw files, to be downloaded by their number."""
    return Table(
        ("raw file", "size", "SHA-256"),
        tuple((file.path, _size(file.size), file.sha256) for file in test.files),
        words=(0, 2),
        title="Raw files, as they came in",
        name="files",
        keys=tuple(range(1, len(test.files) + 1)),
    )


def provenance_table(test: KeptTest) -> Table:
    """By what it was evaluated, with which settings."""
    return Table(("", ""), tuple(_provenance(test)), words=(0, 1), title="How it was evaluated", name="provenance")


def asides_table(test: KeptTest) -> Table:
    """Who set the test aside or took it back, and why."""
    rows = tuple(
        (moment_said(one.at), "set aside" if one.aside else "taken back", one.who, one.why) for one in reversed(test.asides)
    )
    return Table(("when", "what", "who", "why"), rows, words=(0, 1, 2, 3), title="Set aside and taken back", name="asides")


def _provenance(test: KeptTest) -> Iterator[tuple[str, str]]:
    found = test.analysis
    yield "imported", ", ".join(filter(None, (moment_said(test.imported_at), test.who)))
    if found is None:
        yield "evaluated", "not yet"
        return
    yield "evaluated", f"{moment_said(found.made_at)} by elastogeo {found.software}"
    if found.software != test.counts_with:
        yield "counts in the charts with", f"elastogeo {test.counts_with}"
    verb, made = found.settings.get("verb", ""), found.settings.get("made_with", {})
    yield "asked", " ".join(filter(None, (verb, *_question(found.settings.get("question", {})))))
    yield "random draws begin at", str(found.settings.get("seed", ""))
    yield "made with", ", ".join(f"{name} {version}" for name, version in made.items())
    yield "SHA-256 of files and settings", found.inputs_sha256
    yield "SHA-256 of the result", found.document_sha256 or "none"


def _question(question: dict[str, Any]) -> Iterator[str]:
    """What was asked otherwise than nothing."""
    for name, value in question.items():
        if value not in (None, False, [], {}, ""):
            said = listed(str(one) for one in value) if isinstance(value, list) else "" if value is True else str(value)
            yield f"{name.replace('_', ' ')} {said}".strip() + ";"


def _head(test: KeptTest) -> Iterator[tuple[str, str]]:
    yield "Series", test.series
    elsewhere = test.zone not in ("", "+00:00", "Z")
    yield "Measured", f"{moment_said(test.at)}{f' (said as {test.zone})' if elsewhere else ''}"
    if test.instrument:
        yield "Instrument", f"{test.instrument}, {_calibrated(test)}"
    if test.temperature is not None:
        yield "Temperature of the machine", f"{test.temperature:g} °C"
    for name, label in _ABOUT.items():
        if test.about.get(name):
            yield label, str(test.about[name])
    if test.repeats is not None:
        yield "Repeats", f"the suspect test {test.repeats}"


def _calibrated(test: KeptTest) -> str:
    """Whether the instrument was calibrated when the test was measured."""
    if test.calibrated_at is None:
        return "nothing is kept of its calibration"
    said = f"calibrated {date_said(test.calibrated_at)}{f', certificate {test.calibration}' if test.calibration else ''}"
    overdue = test.calibration_due is not None and test.calibration_due < test.at
    return f"{said}; that ran out on {date_said(test.calibration_due)}" if overdue else said


def _checks(found: KeptAnalysis | None) -> tuple[Said, ...]:
    told = ((found.document or {}) if found else {}).get("verdict", [])
    return tuple(Said(one["name"], one["passed"], one["sentence"], one["decisive"]) for one in told)


def _answer(test: KeptTest, checks: tuple[Said, ...]) -> str:
    if test.analysis is None:
        return "This test has not been evaluated yet."
    if test.analysis.error:
        return f"This test could not be evaluated: {test.analysis.error}"
    supported = "support" if test.analysis.supported else "do not support"
    judged = f" {attention_sentence(checks)}" if checks else ""
    return f"The data {supported} what was asked.{judged}"


def _alerts(test: KeptTest) -> Iterator[str]:
    if test.is_aside:
        last = test.asides[-1]
        yield f"Set aside on {date_said(last.at)} by {last.who}: {last.why}. It counts in no chart."
    if test.analysis is not None and test.analysis.software != test.counts_with:
        yield (
            f"The charts of this series count with elastogeo {test.counts_with}; this is what {test.analysis.software} says "
            f"of the test: recompute the series to have both agree."
        )


def _badge(test: KeptTest, checks: tuple[Said, ...]) -> Badge:
    """The state of the answer in shape and words."""
    if test.analysis is None:
        return Badge("–", "Not evaluated yet", "none")
    if test.analysis.error:
        return Badge("■", "Could not be evaluated", "bad")
    if not test.analysis.supported:
        return Badge("■", "Not supported by the data", "bad")
    if any(one.passed is False for one in checks):
        return Badge("▲", "Supported, with points to look at", "care")
    return Badge("●", "Supported", "good")


def _origin(test: KeptTest) -> str:
    return "" if test.origin == "measured" else origin_said(test.origin, test.from_what or test.origin)


def _size(count: int) -> str:
    if count < _KILO:
        return f"{count} B"
    return f"{count / _KILO:.0f} kB" if count < _MEGA else f"{count / _MEGA:.1f} MB"


def _document(test: KeptTest) -> dict[str, Any]:
    found = test.analysis
    told = dict(found.document or {}) if found else {}
    return document(
        SCHEMA,
        {
            **{name: value for name, value in told.items() if name not in ("schema", "software")},
            "result": told.get("schema"),
            "kept": {
                "key": test.key,
                "name": test.name,
                "machine": {"key": test.machine_key, "name": test.machine},
                "series": {"key": test.series_key, "name": test.series},
                "measured": iso_date(test.at),
                "imported": iso_date(test.imported_at),
                "origin": test.origin,
                "simulated": test.from_what,
                "instrument": test.instrument,
                "calibration": test.calibration,
                "calibrated": iso_date(test.calibrated_at),
                "due": iso_date(test.calibration_due),
                "who": test.who,
                "about": test.about,
                "temperature_degC": test.temperature,
                "previous": test.previous,
                "following": test.following,
                "baseline": test.baseline,
                "repeats": test.repeats,
            },
            "files": [
                {"number": k, "path": file.path, "sha256": file.sha256, "bytes": file.size}
                for k, file in enumerate(test.files, 1)
            ],
            "set_aside": [
                {"aside": one.aside, "at": iso_date(one.at), "who": one.who, "why": one.why} for one in test.asides
            ],
            "analysis": None
            if found is None
            else {
                "software": found.software,
                "made_at": iso_date(found.made_at),
                "supported": found.supported,
                "error": found.error,
                "settings": found.settings,
                "inputs_sha256": found.inputs_sha256,
                "document_sha256": found.document_sha256,
            },
        },
    )
