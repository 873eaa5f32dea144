"""Circular tests: circular deviation G, bi-directional G(b), radial deviation F and mean bi-directional radial deviation D.

The parameters are those of ISO 230-4, in own words (no clause is quoted, its text was not at hand). A path is where the
tool went, seen from the centre of the test: at the angle of each reading, at the nominal radius plus the reading.

* **G**, circular deviation: the radii of two concentric circles that just enclose one path differ by it.
* **G(b)**: the same, for circles that enclose the clockwise and the counter-clockwise path together.
* **F**, radial deviation: how far the path is outside the nominal circle at most (`f_max`) and at least (`f_min`).
* **D**: mean radius of both paths less the nominal radius.

The centre of the circles is a choice: `minimum-zone` (the least possible difference of radii: G as defined), `least-squares`
(what most ball-bar software plots), or `set-up` (the instrument's own centre, with its eccentricity). F and D take the
least-squares centre of each full circle, or the set-up's. **They are not a diagnosis**: they do not say which fault it is,
and have no uncertainty.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.faults.enclosing_circles import MAX_GAP, Centre, Path, arc_of, enclosed


@dataclass(frozen=True, slots=True)
class Circularity:
    """The parameters of a circular test; None where `not_determined` says why.

    Attributes
    ----------
    centre : str
        Which centre the circles have.
    g_ccw, g_cw, g_bidirectional : float or None [mm]
        Circular deviation of each direction, and of both together.
    f_max_ccw, f_min_ccw, f_max_cw, f_min_cw : float or None [mm]
        Radial deviation of each direction.
    mean_radial : float or None [mm]
        Mean bi-directional radial deviation D.
    not_determined : tuple of str
        For each parameter that is None, its name and why.
    """

    centre: Centre
    g_ccw: float | None
    g_cw: float | None
    g_bidirectional: float | None
    f_max_ccw: float | None
    f_min_ccw: float | None
    f_max_cw: float | None
    f_min_cw: float | None
    mean_radial: float | None
    not_determined: tuple[str, ...]


def circular_deviation(path: Path, radius: float, centre: Centre = "minimum-zone") -> float:
    """Circular deviation G [mm] of one path; of partial arcs from `LEAST_ARC` on, or of any about the set-up's centre.

    Raises
    ------
    UnsupportedError, InputError
        As `enclosed`.
    """
    return enclosed([path], radius, centre).separation


def bidirectional_circular_deviation(ccw: Path, cw: Path, radius: float, centre: Centre = "minimum-zone") -> float:
    """Bi-directional circular deviation G(b) [mm]: one pair of circles encloses both paths.

    Raises
    ------
    UnsupportedError, InputError
        As `enclosed`, or if the two paths cover different arcs.
    """
    arcs = [math.degrees(arc_of(path.angle)) for path in (ccw, cw)]
    if math.degrees(arc_of(np.concatenate([ccw.angle, cw.angle]))) - min(arcs) > math.degrees(MAX_GAP):
        raise UnsupportedError(
            f"the CCW path covers {arcs[0]:.4g} deg, the CW path {arcs[1]:.4g} deg, and not the same ones; "
            "G(b) compares both directions where both went: repeat the test over one arc"
        )
    return enclosed([ccw, cw], radius, centre).separation


def radial_deviation(path: Path, radius: float, centre: Centre = "least-squares") -> tuple[float, float]:
    """Radial deviations F_max and F_min [mm] of one path, positive away from the centre.

    Raises
    ------
    UnsupportedError
        If the set-up's eccentricity is to be removed and the circle is not full: on an arc, eccentricity and radius cannot
        be distinguished well enough.
    InputError
        As `enclosed`.
    """
    if centre != "set-up":
        _check_full(path, "radial deviation F without the set-up's eccentricity")
    result = enclosed([path], radius, centre)
    return result.f_max, result.f_min


def mean_radial_deviation(ccw: Path, cw: Path, radius: float) -> float:
    """Mean bi-directional radial deviation D [mm]: the mean radius of both least-squares circles less the nominal one.

    Both directions count the same, whatever their number of readings.

    Raises
    ------
    UnsupportedError
        If one of the circles is not full.
    InputError
        As `enclosed`.
    """
    for path in (ccw, cw):
        _check_full(path, "mean bi-directional radial deviation D")
    return math.fsum(enclosed([path], radius, "least-squares").radial for path in (ccw, cw)) / 2


def circularity(
    radius: float, ccw: Path | None = None, cw: Path | None = None, centre: Centre = "minimum-zone"
) -> Circularity:
    """All parameters that the paths of a circular test support.

    Parameters
    ----------
    radius : float [mm]
        Nominal radius.
    ccw, cw : Path, optional
        The counter-clockwise and the clockwise path; one at least.
    centre : {"minimum-zone", "least-squares", "set-up"}
        Of the circles of G and G(b); F is about the least-squares centre unless this is the set-up's.

    Raises
    ------
    InputError
        If there is no path, or as `enclosed`.
    """
    if ccw is None and cw is None:
        raise InputError("a circular test needs a path, counter-clockwise or clockwise; none was given")
    reasons: dict[str, str] = {}
    about: Centre = "set-up" if centre == "set-up" else "least-squares"
    g: dict[str, float | None] = {}
    f: dict[str, tuple[float | None, float | None]] = {}
    for name, path in (("ccw", ccw), ("cw", cw)):
        g[name], f[name] = None, (None, None)
        if path is None:
            reasons |= dict.fromkeys((f"g_{name}", f"f_max_{name}", f"f_min_{name}"), f"there is no {name.upper()} run")
            continue
        try:
            g[name] = circular_deviation(path, radius, centre)
        except UnsupportedError as error:
            reasons[f"g_{name}"] = str(error)
        try:
            f[name] = radial_deviation(path, radius, about)
        except UnsupportedError as error:
            reasons |= dict.fromkeys((f"f_max_{name}", f"f_min_{name}"), str(error))
    both, mean = _of_both(ccw, cw, radius, centre, reasons)
    return Circularity(
        centre, g["ccw"], g["cw"], both, *f["ccw"], *f["cw"], mean, tuple(f"{k}: {why}" for k, why in reasons.items())
    )


def _of_both(
    ccw: Path | None, cw: Path | None, radius: float, centre: Centre, reasons: dict[str, str]
) -> tuple[float | None, float | None]:
    """G(b) and D; why not is added to `reasons`."""
    if ccw is None or cw is None:
        reasons |= dict.fromkeys(("g_bidirectional", "mean_radial"), "both directions are needed")
        return None, None
    both = mean = None
    try:
        both = bidirectional_circular_deviation(ccw, cw, radius, centre)
    except UnsupportedError as error:
        reasons["g_bidirectional"] = str(error)
    try:
        mean = mean_radial_deviation(ccw, cw, radius)
    except UnsupportedError as error:
        reasons["mean_radial"] = str(error)
    return both, mean


def _check_full(path: Path, what: str) -> None:
    arc = arc_of(path.angle)
    if arc < math.tau:
        raise UnsupportedError(f"the {what} needs a full circle; the path covers {math.degrees(arc):.4g} deg")
