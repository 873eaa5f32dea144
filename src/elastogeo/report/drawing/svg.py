"""Figures as files: each is drawn once and written as often as it is needed. matplotlib is imported on use."""

from __future__ import annotations

import re
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

from elastogeo.report.extra import needs_report_extra

if TYPE_CHECKING:
    from elastogeo.report.view import Picture

_INK = {"#222222": "--ink", "#767676": "--soft", "#d9d9d9": "--line"}
"""Colours of the house style that follow the scheme of the page."""

_JOINED = 'stroke-linejoin="round" stroke-linecap="butt"'
"""What matplotlib says of all lines in a style sheet."""


def drawn(picture: Picture) -> bytes:
    """A picture as an SVG file, its letters as text, without a date or version in it.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    with needs_report_extra():
        from elastogeo.report.drawing.style import house_style, laid_out
    buffer = BytesIO()
    with house_style():
        unsaid = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        laid_out(picture.draw()).savefig(buffer, format="svg", metadata=unsaid)
    return buffer.getvalue()


def inline(svg: bytes, picture: Picture) -> str:
    """An SVG file as an element inside a page: no address in it, its identifiers its own, in the page's own colours."""
    text = svg.decode("utf-8")
    text = text[text.index("<svg") :].strip()
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\s(?:xmlns(?::\w+)?)="[^"]*"', "", text)
    text = text.replace("xlink:href=", "href=")
    text = re.sub(r'(\bid="|url\(#|\bhref="#)', rf"\g<1>{picture.name}-", text)
    text = re.sub("|".join(_INK), lambda found: f"var({_INK[found[0]]}, {found[0]})", text)
    text = text.replace("fill: #ffffff", "fill: var(--paper, #ffffff)")
    text = re.sub(r"<style\b.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r'\sstyle="([^"]*)"', lambda found: _attributes(found[1]), text)
    head, rest = text.split(">", 1)
    head = re.sub(r'\s(?:width|height|version)="[^"]*"', "", head)
    return f'{head} {_JOINED} role="img" aria-label="{escape(picture.alternative)}">{rest}'


def _attributes(style: str) -> str:
    """The declarations of a style as attributes: a page that allows no style of its own elements shows them too."""
    pairs = (entry.partition(":") for entry in style.split(";") if entry.strip())
    return "".join(f' {name.strip()}="{value.strip()}"' for name, _, value in pairs)


def svg_of(picture: Picture) -> str:
    """A picture as an element inside a page."""
    return inline(drawn(picture), picture)
