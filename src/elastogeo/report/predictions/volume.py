"""A map to turn: every place a point, coloured by its compliance or U, hollow where the tests tell nothing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elastogeo.machine import Array
from elastogeo.prediction import ComplianceMap
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty
from elastogeo.report.predictions.document import NM, thinned
from elastogeo.report.view import Scene

SOFT = ("#f7fbff", "#a6dbe8", "#56a9d6", "#4878b8", "#6c5aa8", "#a0468f")
"""Colours from the stiffest to the softest."""

_GREY = "#767676"
_MOST, _LEAST_AXES, _MOST_AXES = 6000, 2, 3
"""So many points can still be turned smoothly and are not yet a wall."""
_TICKS, _SURFACES = 5, 4
_SHARPEST = 10
_SAME = 1e-9
"""Values that differ by less, relative, are one value: what is left is the arithmetic's."""


def volume_scene(found: ComplianceMap) -> Scene | None:
    """The page with the volume; none for a line, a single place, or more than three axes."""
    if not _LEAST_AXES <= len(_wide(found)) <= _MOST_AXES:
        return None
    return Scene(
        "volume",
        "The volume, to turn",
        "Every place of the map is a point: point at it for its value, U, and whether the tests tell it.",
        "What the tests do not tell is hollow and has no number.",
        lambda: _drawing(found),
    )


def _wide(found: ComplianceMap) -> list[int]:
    return [k for k, count in enumerate(found.grid.shape) if count > 1]


def _drawing(found: ComplianceMap) -> dict[str, Any]:
    """The figure for plotly.js: traces, of each the choice of the menu that it belongs to (none: all), and the layout."""
    wide, part = _wide(found), tuple(slice(None, None, step) for step in thinned(found, _MOST))
    along = [one[cut] for one, cut in zip(found.grid.along, part, strict=True)]
    every = list(np.meshgrid(*along, indexing="ij"))
    places = [every[k].ravel() for k in wide]
    places += [np.zeros_like(places[0])] * (_MOST_AXES - len(wide))
    told = found.supported[part].ravel()
    fields = {"compliance": found.compliance[part].ravel() * NM, "U (95 %)": found.expanded[part].ravel() * NM}
    hover = _hover(found, every, part)
    data: list[dict[str, Any]] = []
    for choice, values in enumerate(fields.values()):
        known = told & np.isfinite(values)
        traces = [*_points(places, values, known, told, hover), *_surfaces(places, values, known, len(wide))]
        data += [{"choice": choice, **one} for one in traces]
    data += [{"choice": None, **one} for one in _marks(found, wide)]
    layout = {"scene": _axes(found, along, wide), "height": 720}
    steps = sum(one.size for one in along) < sum(found.grid.shape)
    note = "Of the map's places this page shows a part, evenly spread." if steps else ""
    return {"choices": [f"{name} [nm/N]" for name in fields], "data": data, "layout": layout, "note": note}


def _points(
    places: list[Array], values: Array, known: NDArray[np.bool_], told: NDArray[np.bool_], hover: Array
) -> Iterator[dict[str, Any]]:
    """Filled where there is a number, hollow and grey where there is none: not told, or told without an uncertainty."""
    size = max(4.0, min(11.0, 90.0 / len(values) ** (1 / 3)))
    for chosen, name in ((~told, "not told by the tests"), (told & ~known, "no uncertainty: the runs are too few")):
        if chosen.any():
            marker = {"symbol": "circle-open", "size": size, "color": _GREY}
            yield {**_scatter(places, chosen, name, hover), "marker": marker}
    if known.any():
        low, high = float(values[known].min()), float(values[known].max())
        ticks = np.linspace(low, high, _TICKS)
        if high - low <= _SAME * high:
            ticks, low, high = ticks[:1], 0.99 * low, 1.01 * high
        bar = {"tickvals": ticks.tolist(), "ticktext": _ticks(ticks), "thickness": 14, "len": 0.7, "outlinewidth": 0}
        scale = {"cmin": low, "cmax": high, "colorscale": _colours(), "colorbar": {**bar, "title": {"text": "nm/N"}}}
        line = {"width": 0.5, "color": _GREY}
        marker = {"size": size, "color": values[known].tolist(), "line": line, **scale}
        yield {**_scatter(places, known, "told by the tests", hover), "marker": marker}


def _scatter(places: list[Array], chosen: NDArray[np.bool_], name: str, hover: Array) -> dict[str, Any]:
    where = {axis: one[chosen].tolist() for axis, one in zip("xyz", places, strict=True)}
    words = {"name": name, "hovertext": hover[chosen].tolist(), "hoverinfo": "text"}
    return {"type": "scatter3d", "mode": "markers", "showlegend": True, **where, **words}


def _surfaces(places: list[Array], values: Array, known: NDArray[np.bool_], axes: int) -> Iterator[dict[str, Any]]:
    """Surfaces of one value, where the whole volume is told: between places that are not told there is nothing to draw."""
    if axes < _MOST_AXES or not known.all() or np.ptp(values) <= _SAME * values.max():
        return
    low, high = float(values.min()), float(values.max())
    margin = (high - low) / (_SURFACES + 1)
    yield {
        "type": "isosurface",
        **{axis: one.tolist() for axis, one in zip("xyz", places, strict=True)},
        "value": values.tolist(),
        "isomin": low + margin,
        "isomax": high - margin,
        "cmin": low,
        "cmax": high,
        "colorscale": _colours(),
        "surface": {"count": _SURFACES},
        "caps": {axis: {"show": False} for axis in "xyz"},
        "opacity": 0.25,
        "showscale": False,
        "hoverinfo": "skip",
        "name": "surfaces of one value",
        "showlegend": True,
    }


def _marks(found: ComplianceMap, wide: list[int]) -> Iterator[dict[str, Any]]:
    """The softest and the stiffest place, in the ink of the page, unless they rest on a prior."""
    for place, name, symbol in ((found.softest, "softest", "diamond-open"), (found.stiffest, "stiffest", "square-open")):
        if place is not None and found.supported[place.index]:
            where = [float(found.grid.along[k][place.index[k]]) for k in wide] + [0.0] * (_MOST_AXES - len(wide))
            yield {
                "type": "scatter3d",
                "mode": "markers",
                "name": f"the {name}",
                **{axis: [one] for axis, one in zip("xyz", where, strict=True)},
                "hoverinfo": "skip",
                "showlegend": True,
                "marker": {"symbol": symbol, "size": 14, "color": None},
            }


def _hover(found: ComplianceMap, every: list[Array], part: tuple[slice, ...]) -> Array:
    """What each place says: where, value and U, whether the tests tell it; no number where they do not."""
    flat = [one.ravel() for one in every]
    values, spread, told = (one[part].ravel() for one in (found.compliance, found.expanded, found.supported))
    ways = found.directions[part].reshape(-1, 3)
    said = []
    for k, supported in enumerate(told):
        where = " ".join(f"{axis} {one[k]:.6g}" for axis, one in zip(found.grid.axes, flat, strict=True))
        if not supported:
            rest = " (a value that rests on the stated prior is not shown here)" if found.prior else ""
            said.append(f"{pretty(where)} mm<br>not told by the tests{rest}")
            continue
        value = pretty(value_with_uncertainty(values[k] * NM, spread[k] * NM))
        soft = ""
        if found.direction is None:
            soft = pretty(f"<br>softest along ({', '.join(f'{one:.3f}' for one in ways[k])})")
        said.append(f"{pretty(where)} mm<br>{value} nm/N{soft}<br>told by the tests")
    return np.array(said)


def _axes(found: ComplianceMap, along: list[Array], wide: list[int]) -> dict[str, Any]:
    """Axes in true proportion; a plane is looked at from above, without depth."""
    axes: dict[str, Any] = {
        "aspectmode": "data",
        "camera": {"eye": {"x": 1.1, "y": -1.8, "z": 0.9}, "center": {"x": 0.0, "y": 0.0, "z": -0.1}},
    }
    for letter, k in zip("xyz", wide, strict=False):
        chosen = along[k][np.unique(np.linspace(0, len(along[k]) - 1, _TICKS).round().astype(int))]
        text = [pretty(f"{one:.6g}") for one in chosen]
        title = {"text": f"{found.grid.axes[k]} [mm]"}
        axes[f"{letter}axis"] = {"title": title, "tickvals": chosen.tolist(), "ticktext": text, "showspikes": False}
    if len(wide) < _MOST_AXES:
        spans = [float(np.ptp(along[k])) for k in wide]
        ratio = [one / max(spans) for one in spans]
        axes["zaxis"] = {"visible": False, "range": [-1.0, 1.0]}
        axes |= {"aspectmode": "manual", "aspectratio": {"x": ratio[0], "y": ratio[1], "z": 0.05}}
        axes["camera"] = {"eye": {"x": 0.0, "y": 0.0, "z": 1.5}, "up": {"x": 0.0, "y": 1.0, "z": 0.0}}
    return axes


def _ticks(values: Array) -> list[str]:
    """Numbers with as many digits as it takes to tell them apart."""
    for digits in range(3, _SHARPEST):
        said = [pretty(significant(one, digits)) for one in values]
        if len(set(said)) == len(said):
            break
    return said


def _colours() -> list[list[Any]]:
    """The colours without the palest: a point of it would look hollow."""
    return [[k / (len(SOFT) - 2), colour] for k, colour in enumerate(SOFT[1:])]
