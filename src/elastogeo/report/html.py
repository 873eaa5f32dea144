"""One self-contained HTML report: style and figures inside, no script, no request to anywhere. jinja2 is imported on use."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from elastogeo.identification import Identification
from elastogeo.report.context import report_context
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.figures import ALTERNATIVES, figures, inline_svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
    drawn = {name: Markup(svg) for name, svg in _inline(figures(result)).items()}
    return environment.get_template("report.html.j2").render(**report_context(result), figures=drawn)


def save_html(result: Identification, path: str | Path) -> Path:
    """Write the report to a file, UTF-8; its folder is made if it is not there."""
    path = Path(path)
    page = html_report(result)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page, encoding="utf-8", newline="\n")
    return path


def _inline(drawn: Mapping[str, Figure]) -> dict[str, str]:
    return {name: inline_svg(figure, name, ALTERNATIVES[name]) for name, figure in drawn.items()}
