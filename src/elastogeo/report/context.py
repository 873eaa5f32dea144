"""What a report says, ready to print: strings, lists and dicts only. The page and the PDF show the same."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from typing import Any

from elastogeo.estimate import Repeatability
from elastogeo.identification import CONDITION_LIMIT, Check, Circularity, Comparison, Consistency, Diagnosis, Identification
from elastogeo.report.as_json.envelope import instrument_name
from elastogeo.report.budgets import budget_tables, degrees, uncertainty_table
from elastogeo.report.findings import diagnosis_of, diagnosis_rows
from elastogeo.report.numbers import micro, pretty, probability, significant, value_with_uncertainty, written_unit
from elastogeo.report.sentences import sentence_of
from elastogeo.report.text import (
    UM,
    all_separated,
    combination,
    display_units,
    in_micrometres,
    label,
    labels,
    parameter_rows,
)
from elastogeo.report.words import (
    banner,
    change_words,
    confounding_words,
    influences,
    keep_in_mind,
    models_words,
    repeats_words,
    structure_words,
    uncertainty_words,
)
from elastogeo.version import VERSION

Context = dict[str, Any]
_MINUTE = 60.0
_MOVED = 1e-4
"""Of its uncertainty: a constrained value closer to the free one is the same on paper."""


def report_context(result: Identification) -> Context:
    """All that a report says of a result, but the figures."""
    test, found = result.test, result.confounding
    strongest = max(result.levels, key=lambda level: abs(level.force))
    diagnosis, levels = diagnosis_of(result), _levels(result)
    return {
        "version": VERSION,
        "test": {"name": test.name, "machine": test.machine.name, "simulated": test.simulated},
        "facts": facts(result),
        "banner": banner(result),
        "sums": [pretty(label(p)) for p in result.parameters if not p.separated],
        "verdict": [
            {"name": c.name, "passed": c.passed is not False, "sentence": pretty(micro(sentence_of(c)))}
            for c in result.verdict
        ],
        "headline": _headline(sum(check.passed is False for check in result.verdict), len(result.verdict)),
        "brief": _brief(result),
        "rows": _printed(parameter_rows(result)),
        "stands": any(p.separated and len(p.stands_for) > 1 for p in result.parameters),
        "units": pretty("; ".join(_unit_notes(result))),
        "by_run": result.by_run,
        "structure": structure_words(result),
        "highest_force": f"{strongest.force:g}",
        "reference": None if result.reference_force is None else f"{result.reference_force:g}",
        "repeated": len(result.traces) > len(result.levels),
        "uncertainty": uncertainty_words(result),
        "uncertainties": uncertainty_table(result),
        "budgets": budget_tables(result) if influences(result) else [],
        "levels": levels,
        "fits": [level[:4] for level in levels],
        "both": all_separated(result) and {p.elastic for p in result.parameters if p.axis} == {True, False},
        "models": None if result.models is None else _models(result.models),
        "change": [pretty(sentence) for sentence in change_words(result)],
        "consistency": None if result.consistency is None else _consistency(result, result.consistency),
        "diagnosis": None if diagnosis is None else _diagnosis(diagnosis, result),
        "repeats": None if result.repeats is None else _repeats(result, result.repeats),
        "all_told": found.rank == len(found.labels),
        "confounding": confounding_words(found),
        "groups": _groups(result),
        "keep_in_mind": keep_in_mind(result),
    }


def facts(result: Identification) -> list[tuple[str, str]]:
    """What was tested and how, as labelled lines."""
    test, setup = result.test, result.test.setup
    machine = "" if test.machine.name == test.machine.topology.compact else f"{test.machine.name}, "
    lines = [
        ("Machine", f"{machine}{test.machine.topology.compact} {test.machine.topology.iso}"),
        ("Instrument", instrument_name(test).replace("-", " ")),
    ]
    known: dict[str, Any] = {fact.name: fact.value for fact in setup.facts()}
    if "plane" in known:
        plane = f"plane {known['plane']}" if isinstance(known["plane"], str) else "a tilted plane"
        lines.append(("Path", f"circle, {plane}, radius {known['radius']:g} mm, {known['feed'] * _MINUTE:g} mm/min"))
    readings = sum(len(next(iter(run.columns.values()))) for run in test.runs)
    lines.append(("Runs", f"{len(test.runs)}, with {readings} readings"))
    forces = ", ".join(f"{level.force:g}" for level in result.levels)
    if result.reference_force is None:
        lines.append(("Force", f"{forces} N"))
    else:
        lines.append(("Force", f"{forces} N over the reference of {result.reference_force:g} N, which is taken off"))
    resolution = "not given" if test.resolution is None else f"{in_micrometres(test.resolution)} µm"
    return [*lines, ("Resolution", resolution), ("Asked for", ", ".join(test.asked))]


def _said(check: Check) -> Context:
    return {"name": check.name, "passed": check.passed is not False, "sentence": pretty(micro(sentence_of(check)))}


def _headline(failed: int, count: int) -> str:
    if not failed:
        return f"All {count} checks passed."
    points = "One point needs" if failed == 1 else f"{failed} points need"
    return f"{points} attention; {count - failed} of {count} checks passed."


def _brief(result: Identification) -> list[tuple[str, str]]:
    top = max(result.parameters, key=lambda p: p.share)
    strongest = max(result.levels, key=lambda level: abs(level.force))
    found = result.confounding
    lines = [
        (
            "Largest contribution",
            f"{label(top)}: {in_micrometres(top.peak_to_peak)} µm peak to peak, share {100 * top.share:.0f} %",
        ),
        (
            "Fit",
            f"RMSE {in_micrometres(result.rmse)} µm overall; fitness {significant(strongest.fitness)} % "
            f"at {strongest.force:g} N",
        ),
        ("Told apart", f"{found.rank} of {len(found.labels)} parameters or combinations"),
        (
            "Condition number",
            f"{significant(found.condition_scaled)} scaled (limit {CONDITION_LIMIT:g}); "
            f"{significant(found.condition_raw)} raw",
        ),
    ]
    return [(what, pretty(text)) for what, text in lines]


def _printed(rows: Iterable[Any]) -> list[dict[str, str]]:
    """Formatted rows as they are set in print."""
    words = {"meaning", "also"}
    return [{key: text if key in words else pretty(text) for key, text in asdict(row).items()} for row in rows]


def _unit_notes(result: Identification) -> list[str]:
    """Each shown unit in those of the house."""
    by_name = display_units(result)
    notes = {
        f"1 {by_name[p.name].name} = {significant(1 / by_name[p.name].factor, 1)} {written_unit(p.unit)}": None
        for p in result.parameters
        if by_name[p.name].factor != 1
    }
    return list(notes)


def _levels(result: Identification) -> list[list[str]]:
    return [
        [
            f"{level.force:g}",
            str(level.readings),
            in_micrometres(level.rmse),
            significant(level.fitness, 4),
            *(pretty(f"{in_micrometres(low)} to {in_micrometres(high)}") for low, high in (level.elastic, level.geometric)),
        ]
        for level in result.levels
    ]


def _models(models: Comparison) -> Context:
    rows = [
        {
            "name": model.name,
            "supported": model.name == models.supported,
            "parameters": str(len(model.labels)),
            "rmse": in_micrometres(model.rmse),
            "runs": "–" if model.left_out_run is None else in_micrometres(model.left_out_run),
            "levels": "–" if model.left_out_level is None else in_micrometres(model.left_out_level),
            "fitness": f"{min(model.fitness.values()):.1f} to {max(model.fitness.values()):.1f}",
            "p_value": "–" if model.p_value is None else pretty(probability(model.p_value)),
            "bic": pretty(f"{model.bic:.0f}"),
            "exponent": "" if model.exponent is None else f"exponent {model.exponent:.2f}",
        }
        for model in models.models
    ]
    return {"rows": rows, "words": models_words(models)}


def _consistency(result: Identification, found: Consistency) -> Context:
    units = display_units(result)
    rows = []
    for p in result.parameters:
        nearest, factor = found.constrained.get(p.name, p.value), units[p.name].factor
        if p.elastic and abs(nearest - p.value) > _MOVED * p.standard_uncertainty:
            half = (p.interval[1] - p.interval[0]) / 2
            free = pretty(value_with_uncertainty(p.value * factor, half * factor))
            rows.append((p.name, free, pretty(significant(nearest * factor)), units[p.name].name))
    return {"sentence": pretty(found.sentence), "rows": rows}


def _diagnosis(diagnosis: Diagnosis, result: Identification) -> Context:
    words = "The set-up comes last: it is no fault of the machine and has no share."
    shown = ("rank", "meaning", "name", "axis", "distortion_um", "share_percent", "also")
    return {
        "table": [[row[key] for key in shown] for row in _printed(diagnosis_rows(diagnosis, result))],
        "words": words if any(not fault.axis for fault in diagnosis.faults) else "",
        "circularity": [_circularity(force, found) for force, found in diagnosis.circularity.items()],
    }


def _circularity(force: float, found: Circularity) -> list[str]:
    shown = (found.g_ccw, found.g_cw, found.g_bidirectional, found.mean_radial)
    spans = ((found.f_min_ccw, found.f_max_ccw), (found.f_min_cw, found.f_max_cw))
    return [
        f"{force:g}",
        *("–" if value is None else pretty(significant(value * UM)) for value in shown),
        *(
            "–" if low is None or high is None else pretty(f"{significant(low * UM)} to {significant(high * UM)}")
            for low, high in spans
        ),
    ]


def _groups(result: Identification) -> list[tuple[str, str]]:
    """Each retained name and the sum it stands for; a sum of compliance and geometry goes under no name."""
    return [
        (p.name if p.separated else "only the sum is known", pretty(combination(p.stands_for)))
        for p in result.parameters
        if len(p.stands_for) > 1
    ]


def _repeats(result: Identification, repeats: Repeatability) -> Context:
    units, shown = display_units(result), labels(result)
    solution, bounds = repeats.solution, repeats.solution.interval()
    rows = []
    for k, name in enumerate(solution.labels):
        unit, value = units[name], float(solution.values[k])
        half = float(bounds[k, 1] - value) * unit.factor
        spread = (float(solution.standard_uncertainty[k]), float(repeats.combination_std[k]))
        uncertainty, deviation = (pretty(significant(size * unit.factor, 2)) for size in spread)
        estimate = pretty(value_with_uncertainty(value * unit.factor, half))
        freedom = degrees(float(solution.degrees_of_freedom[k]))
        rows.append((pretty(shown[name]), estimate, unit.name, uncertainty, freedom, deviation))
    return {"rows": rows, "words": repeats_words(result)}
