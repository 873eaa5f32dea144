"""One self-contained HTML report: style and figures inside, no script, no request to anywhere. jinja2 is imported on use."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from elastogeo import __version__
from elastogeo.estimate import Repeatability
from elastogeo.identify import CONDITION_LIMIT, Identification
from elastogeo.observe import LoadedBallBar
from elastogeo.report.as_json import instrument_name
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.figures import figures, inline_svg
from elastogeo.report.numbers import significant, value_with_uncertainty, written_unit
from elastogeo.report.text import combination, display_units, in_micrometres, parameter_rows
from elastogeo.report.words import confounding_words, keep_in_mind, listed, structured

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MINUTE = 60.0
_ALTERNATIVES = {
    "traces": "Measured and predicted traces of every force level around the nominal circle",
    "residuals": "Measured minus predicted readings of every force level",
    "contributions": "Contribution of each parameter to the trace, in micrometres",
    "patterns": "Response pattern of each group of parameters",
    "local": "Local estimates with their intervals against the global estimate",
    "repeats": "Estimates from every combination of repeated runs",
}


def html_report(result: Identification) -> str:
    """The report as one HTML page.

    Parameters
    ----------
    result : Identification

    Returns
    -------
    str
        The same for the same result, down to the byte.

    Raises
    ------
    MissingExtraError
        If matplotlib or jinja2 is not installed.
    """
    with needs_report_extra():
        from jinja2 import Environment, PackageLoader, StrictUndefined
        from markupsafe import Markup
    environment = Environment(
        loader=PackageLoader("elastogeo.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["pretty"] = pretty
    environment.filters["micro"] = micro
    drawn = {name: Markup(svg) for name, svg in _inline(figures(result)).items()}
    return environment.get_template("report.html.j2").render(**report_context(result), figures=drawn)


def save_html(result: Identification, path: str | Path) -> Path:
    """Write the report to a file, UTF-8; its folder is made if it is not there."""
    path = Path(path)
    page = html_report(result)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page, encoding="utf-8", newline="\n")
    return path


def report_context(result: Identification) -> dict[str, Any]:
    """All that the template shows but the figures: strings, numbers and lists."""
    failed = [check for check in result.verdict if not check.passed]
    top = max(result.parameters, key=lambda p: p.share)
    strongest = max(result.levels, key=lambda level: abs(level.force))
    return {
        "version": __version__,
        "test": result.test,
        "facts": facts(result),
        "verdict": result.verdict,
        "headline": _headline(len(failed), len(result.verdict)),
        "all_passed": not failed,
        "brief": {
            "largest": f"{top.name}: {in_micrometres(top.peak_to_peak)} µm peak to peak, share {100 * top.share:.0f} %",
            "fit": f"RMSE {in_micrometres(result.rmse)} µm overall; fitness {significant(strongest.fitness)} % "
            f"at {strongest.force:g} N",
            "told": f"{result.confounding.rank} of {len(result.confounding.labels)} parameters or combinations",
            "condition": f"{significant(result.confounding.condition_scaled)} scaled (limit {CONDITION_LIMIT:g}); "
            f"{significant(result.confounding.condition_raw)} raw",
        },
        "repeated": len(result.traces) > len(result.levels),
        "all_told": result.confounding.rank == len(result.confounding.labels),
        "structured": structured(result),
        "rows": parameter_rows(result),
        "units": _unit_notes(result),
        "highest_force": f"{strongest.force:g}",
        "reference": None if result.reference_force is None else f"{result.reference_force:g}",
        "levels": [
            (f"{x.force:g}", str(x.readings), in_micrometres(x.rmse), significant(x.fitness, 4)) for x in result.levels
        ],
        "repeats": None if result.repeats is None else _repeats(result, result.repeats),
        "confounding": confounding_words(result.confounding),
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
    if isinstance(setup, LoadedBallBar):
        plane = f"plane {setup.circle.plane}" if isinstance(setup.circle.plane, str) else "a tilted plane"
        lines.append(("Path", f"circle, {plane}, radius {setup.circle.radius:g} mm, {setup.feed * _MINUTE:g} mm/min"))
    readings = sum(len(next(iter(run.columns.values()))) for run in test.runs)
    lines.append(("Runs", f"{len(test.runs)}, with {readings} readings"))
    forces = ", ".join(f"{level.force:g}" for level in result.levels)
    if result.reference_force is None:
        lines.append(("Force", f"{forces} N"))
    else:
        lines.append(("Force", f"{forces} N over the reference of {result.reference_force:g} N, which is taken off"))
    resolution = "not given" if test.resolution is None else f"{in_micrometres(test.resolution)} µm"
    return [*lines, ("Resolution", resolution), ("Asked for", ", ".join(test.question.parameters))]


def pretty(text: str) -> str:
    """Numbers as they are set in print: a true minus sign, powers of ten."""
    text = re.sub(r"(?<![\d.])1e([+-])(\d+)", lambda m: f"10{_raised(m[1], m[2])}", text)
    text = re.sub(r"e([+-])(\d+)", lambda m: f" × 10{_raised(m[1], m[2])}", text)
    return re.sub(r"(?<![A-Za-z])-(?=[\d ])", "−", text)


def micro(text: str) -> str:
    """A sentence with its `um` as µm."""
    return re.sub(r"(?<=\d )um\b", "µm", text)


def _raised(sign: str, digits: str) -> str:
    raised = digits.lstrip("0").translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return ("⁻" if sign == "-" else "") + raised


def _headline(failed: int, count: int) -> str:
    if not failed:
        return f"All {count} checks passed."
    points = "One point needs" if failed == 1 else f"{failed} points need"
    return f"{points} attention; {count - failed} of {count} checks passed."


def _inline(drawn: Mapping[str, Figure]) -> dict[str, str]:
    return {name: inline_svg(figure, name, _ALTERNATIVES[name]) for name, figure in drawn.items()}


def _unit_notes(result: Identification) -> list[str]:
    """Each shown unit in those of the house."""
    by_name = display_units(result)
    notes = {
        f"1 {by_name[p.name].name} = {significant(1 / by_name[p.name].factor, 1)} {written_unit(p.unit)}": None
        for p in result.parameters
        if by_name[p.name].factor != 1
    }
    return list(notes)


def _groups(result: Identification) -> list[tuple[str, str]]:
    return [(p.name, combination(p.stands_for)) for p in result.parameters if len(p.stands_for) > 1]


def _repeats(result: Identification, repeats: Repeatability) -> dict[str, Any]:
    units = display_units(result)
    solution = repeats.solution
    rows = []
    for k, name in enumerate(solution.labels):
        unit = units[name]
        half = float(solution.interval()[k, 1] - solution.values[k]) * unit.factor
        rows.append(
            (
                name,
                unit.name,
                value_with_uncertainty(float(solution.values[k]) * unit.factor, half),
                significant(float(solution.standard_uncertainty[k]) * unit.factor, 2),
                significant(float(solution.degrees_of_freedom[k]), 2),
                significant(float(repeats.combination_std[k]) * unit.factor, 2),
            )
        )
    return {
        "rows": rows,
        "levels": listed([f"{count} runs at {level}" for level, count in repeats.runs.items()]),
        "combinations": len(repeats.combinations),
    }
