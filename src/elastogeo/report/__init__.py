"""A result becomes a view (sentences, key values, tables, figures, JSON), any view a page, a PDF, files.

It computes nothing new. Stands on `identification` and all rooms below. One wing for each kind of result; `page` renders
any view; `drawing` is the ground of all figures. matplotlib, jinja2, typst and plotly (`elastogeo[report]`) are imported
only when something is drawn or a page is written.
"""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use
from elastogeo.report import showing as _showing  # noqa: F401  the renderer of every result registers itself
from elastogeo.report.days import simulated_said
from elastogeo.report.drawing.plot_svg import plot_svg
from elastogeo.report.drawing.plots import Plot, plot_of
from elastogeo.report.drawing.svg import svg_of
from elastogeo.report.extra import MissingExtraError
from elastogeo.report.numbers import DisplayUnit, display_unit, significant, value_with_uncertainty
from elastogeo.report.page import (
    PLOTLY_CONFIG,
    KeptView,
    csv_of,
    html_page,
    kept_view,
    pdf_page,
    plotly_library,
    save_report,
    view_kept,
)
from elastogeo.report.sentences import says, sentence_of
from elastogeo.report.view import KeyValue, Picture, Said, Section, Table, View, view_of, views

if TYPE_CHECKING:
    from elastogeo.report.faults.cause_document import causes_document

__all__ = [
    "PLOTLY_CONFIG",
    "DisplayUnit",
    "KeptView",
    "KeyValue",
    "MissingExtraError",
    "Picture",
    "Plot",
    "Said",
    "Section",
    "Table",
    "View",
    "causes_document",
    "csv_of",
    "display_unit",
    "html_page",
    "kept_view",
    "pdf_page",
    "plot_of",
    "plot_svg",
    "plotly_library",
    "save_report",
    "says",
    "sentence_of",
    "significant",
    "simulated_said",
    "svg_of",
    "value_with_uncertainty",
    "view_kept",
    "view_of",
    "views",
]

__getattr__ = first_use(__name__, {"faults.cause_document": "causes_document"})  # it draws
