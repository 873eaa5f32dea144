"""The report for the machine's file: a few pages of A4 as PDF, by typst, which is imported on use.

No network, no temporary file, no date: the same result gives the same bytes. All texts go to the template as data and are
never read as markup.
"""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path

from elastogeo.identification import Identification
from elastogeo.report.context import report_context
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.figures import ALTERNATIVES, figure_bytes, figures


def pdf_report(result: Identification) -> bytes:
    """The report as a PDF of A4 pages, tagged for screen readers (PDF/UA-1).

    A text in a script that the embedded fonts lack is set in a font of the system, without the promise of PDF/UA-1.

    Parameters
    ----------
    result : Identification

    Returns
    -------
    bytes
        The same for the same result.

    Raises
    ------
    MissingExtraError
        If matplotlib or typst is not installed.
    """
    with needs_report_extra():
        import typst
    template = files("elastogeo.report").joinpath("templates", "report.typ").read_bytes()
    drawn = {name: figure_bytes(figure, "svg", outlines=True).decode() for name, figure in figures(result).items()}
    data = json.dumps({**report_context(result), "alternatives": ALTERNATIVES, "figures": list(drawn)}, allow_nan=False)
    inputs = {"data": data, **drawn}
    try:
        page = typst.compile(template, sys_inputs=inputs, ignore_system_fonts=True, pdf_standards="ua-1")
    except typst.TypstError as error:
        if "could not be displayed with font" not in str(error):
            raise
        page = typst.compile(template, sys_inputs=inputs)
    return bytes(page)


def save_pdf(result: Identification, path: str | Path) -> Path:
    """Write the PDF report to a file; its folder is made if it is not there."""
    path = Path(path)
    page = pdf_report(result)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(page)
    return path
