"""The head of every page about a test: who, when, which machine and instrument, how, with which files."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from elastogeo.machine import About
from elastogeo.observe import Campaign, MachineTest, campaign_of
from elastogeo.report.days import origin_said
from elastogeo.report.numbers import significant
from elastogeo.report.text import MICRO, in_micrometres
from elastogeo.report.view import Section, Table

_MINUTE = 60.0


def head(test: MachineTest) -> tuple[tuple[str, str], ...]:
    """What was tested and how, as labelled lines; nothing is said of what is not known."""
    topology = test.machine.topology
    readings = sum(len(next(iter(run.columns.values()))) for run in test.runs)
    reference = test.question.reference_force
    files = {run.file for run in test.runs if run.sha256}
    lines = [
        ("Machine", f"{test.machine.name}, {topology.compact} {topology.iso}"),
        *about_lines(test.about, test.instrument.replace("-", " ")),
        ("Path", _path(test)),
        ("Runs", f"{len(test.runs)}, with {readings} readings"),
        ("Asked for", ", ".join(test.asked)),
        ("Reference", "" if reference is None else f"the readings at {reference:g} N are subtracted"),
        ("Resolution", _resolution(test)),
        ("Remarks", test.about.remarks),
        ("Files", f"{len(files)}, their SHA-256 below" if files else ""),
    ]
    return tuple((label, text) for label, text in lines if text)


def about_lines(about: About, instrument: str = "") -> tuple[tuple[str, str], ...]:
    """Who, when, where, with which machine and instrument; empty where it is not known."""
    return (
        ("Machine serial number", about.machine_serial),
        ("Instrument", ", ".join(filter(None, (instrument, about.instrument)))),
        ("Instrument serial number", about.instrument_serial),
        ("Calibrated", about.instrument_calibrated),
        ("Date", about.date),
        ("Operator", about.operator),
        ("Temperature of the machine", "" if about.temperature is None else f"{about.temperature:g} °C"),
        ("Place", about.place),
    )


def campaign_head(campaign: Campaign) -> tuple[tuple[str, str], ...]:
    """What was tested and how: of one test its head, of several what they have together."""
    if not campaign.several:
        return head(campaign.only)
    tests = campaign.tests.values()
    readings = sum(len(next(iter(run.columns.values()))) for test in tests for run in test.runs)
    dates = sorted({test.about.date for test in tests if test.about.date})
    lines = [
        ("Machine", f"{campaign.machine.name}, {campaign.machine.topology.compact} {campaign.machine.topology.iso}"),
        ("Machine serial number", _each_once(test.about.machine_serial for test in tests)),
        ("Tests", ", ".join(campaign.tests)),
        ("Instruments", _each_once(test.instrument.replace("-", " ") for test in tests)),
        ("Instrument serial numbers", _each_once(test.about.instrument_serial for test in tests)),
        ("Date", " to ".join(dict.fromkeys((dates[0], dates[-1]))) if dates else ""),
        ("Runs", f"{campaign.runs}, with {readings} readings"),
        ("Asked for", ", ".join(campaign.asked)),
    ]
    return tuple((label, text) for label, text in lines if text)


def _each_once(words: Iterable[str]) -> str:
    return ", ".join(dict.fromkeys(filter(None, words)))


def files_section(one: MachineTest | Campaign) -> tuple[Section, ...]:
    """The files that the runs were read from, with their hashes; none where there are none."""
    campaign = campaign_of(one)
    rows = tuple(
        (f"{name}/{run.name}" if campaign.several else run.name, run.file, run.sha256)
        for name, test in campaign.tests.items()
        for run in test.runs
        if run.sha256
    )
    return (Section("Files", tables=(Table(("run", "file", "SHA-256"), rows, words=(0, 1, 2)),)),) if rows else ()


def origin(one: MachineTest | Campaign) -> str:
    """Whether the readings, or which of them, are simulated or reconstructed, and from what; empty if all were measured."""
    campaign = campaign_of(one)
    if campaign.several:
        return "; ".join(filter(None, (_origin_among(campaign, kind) for kind in ("simulated", "reconstructed"))))
    test = campaign.only
    if test.reconstructed:
        return origin_said("reconstructed", test.reconstructed)
    if not test.simulated:
        return ""
    marked = sum(bool(run.simulated) for run in test.runs)
    some = f" ({marked} of {len(test.runs)} runs)" if 0 < marked < len(test.runs) else ""
    return origin_said(f"simulated{some}", test.simulated)


def _origin_among(campaign: Campaign, kind: str) -> str:
    """Which of several tests are `simulated` or `reconstructed`, and from what; empty if none is."""
    told = {name: getattr(test, kind) for name, test in campaign.tests.items() if getattr(test, kind)}
    some = f" ({', '.join(told)})" if 0 < len(told) < len(campaign.tests) else ""
    return origin_said(f"{kind}{some}", "; ".join(dict.fromkeys(told.values())))


def _resolution(test: MachineTest) -> str:
    if test.resolution is None:
        return "not stated"
    angles = test.setup.reads_angles
    return f"{significant(test.resolution * MICRO)} µrad" if angles else f"{in_micrometres(test.resolution)} µm"


def _path(test: MachineTest) -> str:
    known: dict[str, Any] = {fact.name: fact.value for fact in test.setup.facts()}
    if "plane" not in known:
        return ""
    plane = f"plane {known['plane']}" if isinstance(known["plane"], str) else "a tilted plane"
    return f"circle, {plane}, radius {known['radius']:g} mm, {known['feed'] * _MINUTE:g} mm/min"
