"""Templates, and what every one of them knows."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from typing import Any
from urllib.parse import unquote

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from elastogeo.report import Picture, plot_svg, svg_of
from elastogeo.version import VERSION
from elastogeo.web.asking import SAID, Asked

STATIC = files("elastogeo.web") / "static"


def page(name: str, asked: Asked, **context: Any) -> str:
    """A template, filled.

    Parameters
    ----------
    name : str
        Its file, below `templates`.
    asked : Asked
    context
        What it shows.
    """
    return (
        _environment()
        .get_template(name)
        .render(
            asked=asked,
            url=asked.url,
            static=lambda file: f"{asked.settings.prefix}/static/{file}?v={_digest(file)}",
            visitor=asked.visitor,
            theme=asked.theme,
            said=unquote(asked.request.cookies.get(SAID, "")),
            version=VERSION,
            **context,
        )
    )


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("elastogeo.web"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"drawn": _drawn, "plot": lambda plot: Markup(plot_svg(plot)), "strong": _strong, "coded": _coded}
    return environment


def _strong(sentence: str, words: Iterable[str]) -> Markup:
    """A sentence with some of its words set bold, where they come first."""
    text = escape(sentence)
    for one in dict.fromkeys(filter(None, words)):
        text = text.replace(escape(one), Markup("<b>{}</b>").format(one), 1)
    return text


def _coded(text: str) -> Markup:
    """A sentence of the code's own documentation, with what stands between backticks as code."""
    parts = text.split("`")
    return Markup("").join(Markup("<code>{}</code>").format(one) if k % 2 else escape(one) for k, one in enumerate(parts))


def _drawn(picture: Picture) -> Markup:
    """A picture as an SVG element, in the page's own colours."""
    return Markup(svg_of(picture) if picture.plain is None else plot_svg(picture.plain()))


@cache
def _digest(file: str) -> str:
    """A few digits of a file's hash: its address is another one when it changes."""
    return hashlib.sha256((STATIC / file).read_bytes()).hexdigest()[:12]
