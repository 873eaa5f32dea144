"""A view for the machine's file: a few pages of A4 as PDF, by typst, which is imported on use.

No network, no temporary file, no date: the same view gives the same bytes. All texts go to the template as data and are
never read as markup.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

from elastogeo.report.drawing.svg import drawn
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.view import Section, View
from elastogeo.version import VERSION


def pdf_page(view: View, figures: Mapping[str, bytes] | None = None) -> bytes:
    """A view as a PDF of A4 pages, tagged for screen readers (PDF/UA-1).

    A text in a script that the embedded fonts lack is set in a font of the system, without the promise of PDF/UA-1.

    Parameters
    ----------
    view : View
    figures : mapping of str to bytes, optional
        Its pictures as SVG files, if they have been drawn already.

    Returns
    -------
    bytes
        The same for the same view.

    Raises
    ------
    MissingExtraError
        If matplotlib or typst is not installed.
    """
    with needs_report_extra():
        import matplotlib
        import typst
    svg = {name: drawn(picture) for name, picture in view.pictures.items()} if figures is None else figures
    template = files("elastogeo.report.page").joinpath("templates", "page.typ").read_bytes()
    inputs = {"data": json.dumps(_data(view), allow_nan=False), **{name: data.decode() for name, data in svg.items()}}
    fonts: Any = [str(Path(matplotlib.get_data_path()) / "fonts" / "ttf")]
    try:
        page = typst.compile(template, sys_inputs=inputs, font_paths=fonts, ignore_system_fonts=True, pdf_standards="ua-1")
    except typst.TypstError as error:
        if "could not be displayed with font" not in str(error):
            raise
        page = typst.compile(template, sys_inputs=inputs, font_paths=fonts)
    return bytes(page)


def _data(view: View) -> dict[str, Any]:
    """The view as JSON for the template, without what draws its pictures, and without its own document and rows."""
    bare = replace(view, document={}, rows=(), picture=None, sections=(), scene=None)
    pictures = {name: {"caption": p.caption, "alternative": p.alternative} for name, p in view.pictures.items()}
    return {
        **asdict(bare),
        "version": VERSION,
        "first": None if view.picture is None else view.picture.name,
        "pictures": pictures,
        "attention": [asdict(check) for check in view.attention],
        "passed": [asdict(check) for check in view.passed],
        "sections": [_section(section) for section in view.sections],
    }


def _section(section: Section) -> dict[str, Any]:
    return {**asdict(replace(section, pictures=())), "pictures": [picture.name for picture in section.pictures]}
