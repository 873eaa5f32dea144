"""One self-contained HTML page of a view: style and figures inside, no script, no request. jinja2 is imported on use."""

from __future__ import annotations

from collections.abc import Mapping

from elastogeo.report.drawing.svg import drawn, inline
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.view import View
from elastogeo.version import VERSION


def html_page(view: View, figures: Mapping[str, bytes] | None = None, scene_written: bool | None = None) -> str:
    """A view as one HTML page.

    Parameters
    ----------
    view : View
    figures : mapping of str to bytes, optional
        Its pictures as SVG files, if they have been drawn already.
    scene_written : bool, optional
        Whether the page of its scene lies beside it; without, nothing is said of that page.

    Returns
    -------
    str
        The same for the same view, down to the byte.

    Raises
    ------
    MissingExtraError
        If matplotlib or jinja2 is not installed.
    """
    with needs_report_extra():
        from jinja2 import Environment, PackageLoader, StrictUndefined
        from markupsafe import Markup
    environment = Environment(
        loader=PackageLoader("elastogeo.report.page"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    files = {name: drawn(picture) for name, picture in view.pictures.items()} if figures is None else figures
    elements = {name: Markup(inline(files[name], picture)) for name, picture in view.pictures.items()}
    return environment.get_template("page.html.j2").render(
        view=view, figures=elements, version=VERSION, scene_written=scene_written
    )
