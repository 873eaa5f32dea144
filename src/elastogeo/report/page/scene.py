"""A picture that can be turned, on a page of its own: plotly.js inside, nothing asked of another host, nothing sent.

plotly and jinja2 are imported on use. The report itself stays one file without scripts.
"""

from __future__ import annotations

import json
from typing import Any

from elastogeo.report.extra import MissingExtraError, needs_report_extra
from elastogeo.report.view import View
from elastogeo.version import VERSION

PLOTLY_CONFIG: dict[str, Any] = {
    "displaylogo": False,
    "responsive": True,
    "showSendToCloud": False,
    "plotlyServerURL": "",
    "modeBarButtonsToRemove": ["sendChartToCloud", "sendDataToCloud"],
}
"""Without the button that sends the data to plotly's cloud, without its address, and without the link to its makers."""


def plotly_library() -> bytes:
    """plotly.js, as the installed package holds it.

    Raises
    ------
    MissingExtraError
        If plotly is not installed.
    """
    try:
        from plotly.offline import get_plotlyjs
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "plotly":
            raise
        raise MissingExtraError("plotly is not installed; install it with: pip install 'elastogeo[report]'") from error
    return str(get_plotlyjs()).encode()


def scene_page(view: View) -> str | None:
    """The page of a view's scene; none if it has none, or if plotly is not installed.

    Returns
    -------
    str or None
        The same for the same view and plotly.

    Raises
    ------
    MissingExtraError
        If jinja2 is not installed.
    """
    if view.scene is None:
        return None
    try:
        from plotly.offline import get_plotlyjs
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "plotly":
            raise
        return None
    with needs_report_extra():
        from jinja2 import Environment, PackageLoader, StrictUndefined
        from markupsafe import Markup
    loader = PackageLoader("elastogeo.report.page")
    environment = Environment(
        loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    drawing = view.scene.draw()
    figure = {**drawing, "config": PLOTLY_CONFIG}
    # a name with </script> in it must not end the element that holds the data
    data = json.dumps(figure, allow_nan=False, ensure_ascii=False).replace("<", "\\u003c")
    return environment.get_template("scene.html.j2").render(
        view=view, scene=view.scene, drawing=drawing, data=Markup(data), library=Markup(get_plotlyjs()), version=VERSION
    )
