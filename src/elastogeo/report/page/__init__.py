"""Any view as an HTML page that opens offline, and as a PDF; a report's files, written whole or not at all."""

from elastogeo.report.page.csv import csv_of
from elastogeo.report.page.files import save_report
from elastogeo.report.page.html import html_page
from elastogeo.report.page.kept import KeptView, kept_view, view_kept
from elastogeo.report.page.pdf import pdf_page
from elastogeo.report.page.scene import PLOTLY_CONFIG, plotly_library

__all__ = [
    "PLOTLY_CONFIG",
    "KeptView",
    "csv_of",
    "html_page",
    "kept_view",
    "pdf_page",
    "plotly_library",
    "save_report",
    "view_kept",
]
