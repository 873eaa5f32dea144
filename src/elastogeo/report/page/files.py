"""The files of a report: a page, a PDF, JSON, the figures; all of them, or none."""

from __future__ import annotations

import json
from pathlib import Path

from elastogeo.formats import write_whole
from elastogeo.report.drawing.svg import drawn
from elastogeo.report.page.html import html_page
from elastogeo.report.page.pdf import pdf_page
from elastogeo.report.page.scene import scene_page
from elastogeo.report.view import View


def save_report(view: View, folder: str | Path) -> Path:
    """Write the report of a view: `report.html`, `report.pdf`, `report.json`, each figure as SVG, and a scene as its page.

    Without plotly the page of a scene is not written; the report says so.

    Parameters
    ----------
    view : View
    folder : str or Path
        Made if it is not there.

    Returns
    -------
    Path
        Of the HTML page.

    Raises
    ------
    MissingExtraError
        If matplotlib, jinja2 or typst is not installed.
    FormatError
        If a file cannot be written; what was there stays as it was.
    """
    folder = Path(folder)
    figures = {name: drawn(picture) for name, picture in view.pictures.items()}
    turned = scene_page(view)
    written = {
        **{f"{name}.svg": data for name, data in figures.items()},
        "report.json": json.dumps(dict(view.document), indent=2, allow_nan=False, ensure_ascii=False).encode(),
        "report.pdf": pdf_page(view, figures),
        "report.html": html_page(view, figures, scene_written=turned is not None).encode(),
    }
    if view.scene is not None and turned is not None:
        written[f"{view.scene.name}.html"] = turned.encode()
    write_whole({folder / name: data for name, data in written.items()})
    return folder / "report.html"
