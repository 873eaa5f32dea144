"""The views of campaigns that a history keeps: a list, and one with what its tests say together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from elastogeo.changes import KeptCampaign, KeptCampaigns
from elastogeo.report.changes.records_view import differing_line
from elastogeo.report.days import iso_date, short_date, simulated_said
from elastogeo.report.document import document
from elastogeo.report.numbers import display_unit, p_said, pretty, significant, value_with_uncertainty
from elastogeo.report.text import MOST_TERMS, combination
from elastogeo.report.view import Badge, Said, Table, View, attention_sentence, views

_SHOWN = 20
"""Entries that differ that are shown."""
_SHARE = 100.0


@views(KeptCampaigns)
def campaigns_view(kept: KeptCampaigns) -> View:
    """Which sets of tests were asked together."""
    rows = tuple(
        (one.name, one.machine, short_date(one.made_at), str(len(one.tests)), _state(one), str(one.key))
        for one in kept.campaigns
    )
    count = len(kept.campaigns)
    of = f" of {kept.machine}" if kept.machine else ""
    entries = [
        {
            "number": one.key,
            "machine": one.machine,
            "name": one.name,
            "made_at": iso_date(one.made_at),
            "tests": one.tests,
            "supported": one.supported,
            "error": one.error,
            "software": one.software,
        }
        for one in kept.campaigns
    ]
    return View(
        kind="Campaigns",
        title=kept.machine or "all machines",
        subtitle=f"{count} {'campaign' if count == 1 else 'campaigns'}",
        origin=_origin(kept.campaigns),
        sentence=f"{count} {'campaign is' if count == 1 else 'campaigns are'} kept{of}."
        if count
        else f"No campaign{of} is kept: a campaign comes in with its tests, by the import of its folder.",
        document=document("elastogeo.campaigns-kept/1", {"machine": kept.machine, "campaigns": entries}),
        rows=entries,
        tables=(
            Table(
                ("campaign", "machine", "kept", "tests", "says", "number"),
                rows,
                words=(0, 1, 2, 4),
                name="campaigns",
                keys=tuple(one.key for one in kept.campaigns),
            ),
        )
        if rows
        else (),
    )


@views(KeptCampaign)
def campaign_view(kept: KeptCampaign) -> View:
    """What tests that are kept as a set say together."""
    whole = kept.document or {}
    checks = tuple(Said(one["name"], one["passed"], one["sentence"], one["decisive"]) for one in whole.get("verdict", []))
    tables = (_parameters(whole), _tests(kept, whole))
    return View(
        kind="Campaign",
        title=kept.name,
        subtitle=kept.machine,
        origin=_origin((kept,)),
        head=(("Kept", short_date(kept.made_at)), ("Computed by", f"elastogeo {kept.software}")),
        sentence=(kept.error or f"{_answer(kept)} {attention_sentence(checks)}".rstrip()) + _again(kept),
        checks=checks,
        document=document(
            "elastogeo.campaign-kept/1",
            {**asdict(kept), "made_at": iso_date(kept.made_at), "document": kept.document},
        ),
        rows=whole.get("parameters", []),
        tables=tuple(table for table in tables if table.rows),
        notes=tuple(f"Differs: {differing_line(entry)}" for entry in kept.differing[:_SHOWN]),
        badge=Badge("●", "Supported", "good") if kept.supported else Badge("▲", "Not supported", "care"),
    )


def _parameters(whole: Mapping[str, Any]) -> Table:
    """Each parameter with its interval, which tests tell it, and whether only together."""
    together = set(whole.get("together", ()))
    entries = whole.get("parameters", [])
    largest: dict[str, float] = {}
    for one in entries:
        ends = [abs(one["value"]), *map(abs, one["interval95"] or ())]
        largest[one["unit"]] = max(largest.get(one["unit"], 0.0), *ends)
    rows = tuple(_parameter_row(one, largest[one["unit"]], together) for one in entries)
    return Table(
        ("parameter", "value ± U (95 %)", "unit", "told by"),
        rows,
        words=(0, 2, 3),
        title="What they say together",
        note="" if all(one["interval95"] for one in entries) else "Without ±: the runs are too few for an uncertainty.",
        name="parameters",
    )


def _parameter_row(one: Mapping[str, Any], largest: float, together: set[str]) -> tuple[str, ...]:
    unit = display_unit(one["unit"], largest)
    name = one["name"] if one["separated"] else combination(one["stands_for"], MOST_TERMS)
    interval = one["interval95"]
    value = one["value"] * unit.factor
    said = (
        significant(value)
        if interval is None
        else value_with_uncertainty(value, (interval[1] - interval[0]) / 2 * unit.factor)
    )
    return name, pretty(said), unit.name, "the tests together" if one["name"] in together else "a test alone"


def _tests(kept: KeptCampaign, whole: Mapping[str, Any]) -> Table:
    """What each test brings, and whether it agrees with the others."""
    entries = {one["id"]: one for one in whole.get("tests", []) if "id" in one}
    rows = tuple(_test_row(name, key, entries.get(name, {})) for name, key in kept.tests.items())
    return Table(
        ("test", "instrument", "readings", "combinations alone", "adds", "against the others", "number"),
        rows,
        words=(0, 1, 5),
        title="Its tests",
        note="Against the others: how often tests that agree would differ as much, or more.",
        name="tests",
        keys=tuple(kept.tests.values()),
    )


def _test_row(name: str, key: int, entry: Mapping[str, Any]) -> tuple[str, ...]:
    against = entry.get("against_others") or {}
    p_value = against.get("p_value")
    adds = entry.get("adds", [])
    return (
        name,
        entry.get("instrument", ""),
        str(entry.get("readings", "")),
        str(entry.get("rank", "")),
        str(len(adds)) if isinstance(adds, list) else str(adds),
        "" if p_value is None else pretty(p_said(p_value)),
        str(key),
    )


def _again(kept: KeptCampaign) -> str:
    """What computing it again found; nothing if it was not computed again, or by another version."""
    if kept.same_bits is None:
        return ""
    if kept.same_bits:
        return " Computed again, it is the same to the last bit."
    return " Computed again, it differs." if kept.differing else " Computed again, it differs in last digits only."


def _answer(kept: KeptCampaign) -> str:
    count = len(kept.tests)
    tests = "one test" if count == 1 else f"{count} tests"
    return f"{tests[:1].upper()}{tests[1:]} together {'support' if kept.supported else 'do not support'} what was asked."


def _state(one: KeptCampaign) -> str:
    return "an error" if one.error else "what was asked is supported" if one.supported else "not supported"


def _origin(kept: tuple[KeptCampaign, ...]) -> str:
    said = dict.fromkeys(((one.document or {}).get("test") or {}).get("simulated", "") for one in kept)
    return simulated_said("\n".join(filter(None, said)))
