"""All figures of a result, and their files. matplotlib is imported when the first one is drawn."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from elastogeo.errors import InputError
from elastogeo.identification import Identification
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.findings import diagnosis_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("svg", "png")
"""Formats that figures are saved in."""
ALTERNATIVES = {
    "traces": "Measured and predicted traces of every force level around the nominal circle",
    "residuals": "Measured minus predicted readings of every force level",
    "contributions": "Contribution of each parameter to the trace, in micrometres, with its interval",
    "patterns": "Response pattern of each group of parameters",
    "separation": "What compliance and geometry together, compliance alone and geometry alone do to the trace",
    "diagnosis": "Distortion of the trace by each fault, in micrometres, with its interval",
    "local": "Local estimates with their intervals against the global estimate",
    "models": "Error of each model over all readings, at left-out runs and at left-out force levels",
    "budget": "Share of each influence in the variance of each parameter",
    "repeats": "Estimates from every combination of repeated runs",
}
"""What each figure shows, for those who cannot see it."""
_DPI = 200


def figures(result: Identification) -> dict[str, Figure]:
    """Every figure that a result has something to show in, by name.

    Parameters
    ----------
    result : Identification

    Returns
    -------
    dict of str to matplotlib Figure
        `traces`, `residuals`, `contributions`, `patterns`; `separation` if compliance and geometry were both identified and
        told apart; `diagnosis` if there is geometry to rank; `local` if there are two force levels; `models` if models of
        the compliance were compared; `budget` if it holds more than the scatter; `repeats` if any level was repeated.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    with needs_report_extra():
        from elastogeo.report.contributions import contributions_figure, diagnosis_figure
        from elastogeo.report.estimates import local_figure, repeats_figure
        from elastogeo.report.patterns import patterns_figure
        from elastogeo.report.separation import has_both, separation_figure
        from elastogeo.report.style import house_style
        from elastogeo.report.traces import residuals_figure, traces_figure
        from elastogeo.report.uncertainties import budget_figure, has_influences, models_figure
    diagnosis = diagnosis_of(result)
    with house_style():
        drawn = {
            "traces": traces_figure(result),
            "residuals": residuals_figure(result),
            "contributions": contributions_figure(result),
            "patterns": patterns_figure(result),
        }
        if has_both(result):
            drawn["separation"] = separation_figure(result)
        if diagnosis is not None:
            drawn["diagnosis"] = diagnosis_figure(diagnosis, result)
        if result.local:
            drawn["local"] = local_figure(result)
        if result.models is not None:
            drawn["models"] = models_figure(result.models)
        if has_influences(result):
            drawn["budget"] = budget_figure(result)
        if result.repeats is not None:
            drawn["repeats"] = repeats_figure(result, result.repeats)
    return drawn


def save_figures(result: Identification, folder: str | Path, formats: Sequence[str] = FORMATS) -> list[Path]:
    """Save every figure of a result as `<name>.<format>`; the same result gives the same bytes.

    Parameters
    ----------
    result : Identification
    folder : str or Path
        Made if it is not there.
    formats : sequence of str
        Some of `svg`, `png`.

    Returns
    -------
    list of Path
        The files, figure by figure.

    Raises
    ------
    InputError
        If a format is unknown.
    MissingExtraError
        If matplotlib is not installed.
    """
    unknown = [name for name in formats if name not in FORMATS]
    if unknown:
        raise InputError(f"figures cannot be saved as {', '.join(unknown)}; the formats are {', '.join(FORMATS)}")
    return save_drawn(figures(result), folder, formats)


def save_drawn(drawn: Mapping[str, Figure], folder: str | Path, formats: Sequence[str]) -> list[Path]:
    """Save figures by name as `<name>.<format>` in a folder, which is made if it is not there; return the files in order."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name, figure in drawn.items():
        for kind in formats:
            path = folder / f"{name}.{kind}"
            path.write_bytes(figure_bytes(figure, kind))
            paths.append(path)
    return paths


def figure_bytes(figure: Figure, kind: str, outlines: bool = False) -> bytes:
    """A figure as a file of this kind, without date or version in it; with outlines, its SVG needs no font."""
    from elastogeo.report.style import house_style

    unsaid = ("Date", "Creator", "Format", "Type") if kind == "svg" else ("Software",)
    buffer = BytesIO()
    with house_style(outlines):
        figure.savefig(buffer, format=kind, dpi=_DPI, metadata=dict.fromkeys(unsaid))
    return buffer.getvalue()


def inline_svg(figure: Figure, name: str, title: str) -> str:
    """A figure as an SVG element to stand inside a page: no address in it, its identifiers its own, as wide as it may be."""
    text = figure_bytes(figure, "svg").decode("utf-8")
    text = text[text.index("<svg") :].strip()
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\s(?:xmlns(?::\w+)?)="[^"]*"', "", text)
    text = text.replace("xlink:href=", "href=")
    text = re.sub(r'(\bid="|url\(#|\bhref="#)', rf"\g<1>{name}-", text)
    head, rest = text.split(">", 1)
    head = re.sub(r'\s(?:width|height|version)="[^"]*"', "", head)
    return f'{head} role="img" aria-label="{title}">{rest}'
