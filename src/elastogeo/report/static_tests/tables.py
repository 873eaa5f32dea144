"""A static test in words and figures: tables for every reader, and the hysteresis loops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.identification.static_tests import (
    Cartesian,
    LoadedPlace,
    LoadedRun,
    OnAxis,
    OnAxisPart,
    Principal,
    StaticLine,
    StaticResults,
    TwistPlace,
    TwistRun,
)
from elastogeo.machine import Array
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.numbers import UNKNOWN, significant, value_with_uncertainty
from elastogeo.report.view import KeyValue, Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

UM = 1000.0
"""Micrometres in a millimetre; N/µm are thousands of N/mm."""
_MICRO = 1e6
"""Nanometres in a millimetre, and microradians in a radian."""
_NANO = 1e9
_PER_KN = 1000.0
_AXES = "XYZ"
KEY_VALUES = 5
_CYCLES = "u: standard uncertainty by the scatter of the run's own cycles; another run may differ by more."
_CURVE = 200
"""Points of a drawn curve."""
_POINTS = 1500
"""Readings of a run that are drawn: more would be a black band, and a large file."""


def static_tables(found: StaticResults) -> tuple[Table, ...]:
    """All that the instrument itself shows: `value ± U`, U half the 95 % interval; without U where none is known."""
    tables: list[Table] = []
    if found.places:
        tables += _loading(found.places)
    if found.cartesian is not None:
        tables += _cartesian(found.cartesian)
    if found.twists:
        tables += _twists(found.twists, found.twist_places)
    return tuple(tables)


def _loading(places: Sequence[LoadedPlace]) -> Iterator[Table]:
    """Hysteresis by run, the straight lines, the drives."""
    cycled = [run for place in places for run in place.runs if run.hysteresis is not None]
    if cycled:
        headings = ("run", "cycles", "forces [N]", "compliance [nm/N]", "mean hysteresis [µm]", "energy lost [N·mm]")
        rows, title = tuple(map(_hysteresis_row, cycled)), "Static compliance and hysteresis"
        shown = any(run.hysteresis is not None and run.hysteresis.by_cycle for run in cycled)
        yield Table(headings, rows, title=title, note=_CYCLES if shown else "")
        headings = ("run", "greatest [µm]", "at [N]", "at zero force [µm]", "backlash [µm]", "remaining [µm]")
        yield _filled(Table(headings, tuple(map(_widths_row, cycled)), title="Hysteresis at a force"))
    lines = tuple(_line_row(place) for place in places if place.line is not None)
    note = " ".join(f"{_place(place)}: {place.refusal}." for place in places if place.refusal)
    if lines or note:
        asked: tuple[str, ...] = (
            "place",
            "direction",
            "runs",
            "compliance [nm/N]",
            "stiffness [N/µm]",
            "at zero [µm]",
            "off it [µm]",
        )
        yield Table(asked, lines, words=(0, 1), title="Straight line through all runs", note=note)
    for place in places:
        if place.drive is not None:
            yield _drive(place.drive)


def _hysteresis_row(run: LoadedRun) -> tuple[str, ...]:
    found = run.hysteresis
    assert found is not None
    low, high = found.range
    return (
        run.run,
        str(len(found.cycles)),
        f"{low:.4g} to {high:.4g}",
        _of_cycles(found.static_compliance, _MICRO),
        _of_cycles(found.mean_hysteresis, UM),
        _of_cycles(found.energy_lost, 1.0),
    )


def _widths_row(run: LoadedRun) -> tuple[str, ...]:
    found = run.hysteresis
    assert found is not None
    return (
        run.run,
        _of_cycles(found.greatest_hysteresis, UM),
        f"{found.greatest_at:.4g}",
        _of_cycles(found.hysteresis_at_zero, UM),
        _of_cycles(found.backlash, UM),
        _of_cycles(found.remaining, UM),
    )


def _filled(table: Table) -> Table:
    """The table without columns that say nothing in any row."""
    kept = [k for k in range(len(table.headings)) if any(row[k] for row in table.rows)]
    rows = tuple(tuple(row[k] for k in kept) for row in table.rows)
    return replace(table, headings=tuple(table.headings[k] for k in kept), rows=rows)


def _line_row(place: LoadedPlace) -> tuple[str, ...]:
    line = place.line
    assert line is not None
    return (
        _place(place),
        _vector(place.direction),
        str(len(place.runs)),
        _said(line.compliance, _MICRO),
        _stiffness(line),
        _said(line.offset, UM),
        significant(line.nonlinearity * UM, 3),
    )


def _drive(found: OnAxis) -> Table:
    rows = [
        (
            part.name,
            _said_half(part.compliance.value, part.compliance.interval(), _MICRO),
            _stiffness(part),
            "" if part.share is None else f"{100 * part.share:.1f}",
            "" if part.acts else "inside the position loop: not counted",
        )
        for part in found.parts
    ]
    if found.whole is not None:
        whole = OnAxisPart(("whole",), found.whole, True, None, None)
        rows.append(("whole", _said_half(found.whole.value, found.whole.interval(), _MICRO), _stiffness(whole), "100.0", ""))
    title = f"Where axis {found.axis} yields (position loop closed on the {found.feedback})"
    headings = ("part", "compliance [nm/N]", "stiffness [N/µm]", "share [%]", "")
    return Table(headings, tuple(rows), (0, 4), title, " ".join((*found.limits, *_held(found))))


def _held(found: OnAxis) -> Iterator[str]:
    """Whether the motor holds the load, as its current says; nothing where that was not logged or has no uncertainty."""
    if found.current is None or not found.current.known:
        return
    low, high = found.current.interval()
    slope = f"The current of {found.axis} follows the force by {_said(found.current, _PER_KN)} A/kN"
    if low <= 0 <= high:
        yield (
            f"{slope}, which may be nothing: friction may hold the axis, and what departs from the command is then not the "
            f"stiffness of its servo."
        )
    else:
        yield f"{slope}: the motor holds it."


def _cartesian(found: Cartesian) -> Iterator[Table]:
    """Compliance, stiffness, principal directions."""
    compliance, interval = found.compliance.compliance, found.compliance.interval()
    rows = tuple(
        (f"along {_AXES[i]}", *(_said_half(compliance[i, j], interval[i, j], _MICRO) for j in range(3))) for i in range(3)
    )
    columns = tuple(f"force along {axis}" for axis in _AXES)
    yield Table(("displacement", *columns), rows, title="Cartesian compliance [nm/N], in the foundation", note=found.refusal)
    if found.stiffness is not None and found.stiffness_uncertainty is not None:
        K, u, known = found.stiffness / UM, found.stiffness_uncertainty / UM, found.compliance.counted.by_run
        matrix = tuple(
            (
                f"along {_AXES[i]}",
                *(significant(K[i, j], 4) + (f" (u {significant(u[i, j], 2)})" if known else "") for j in range(3)),
            )
            for i in range(3)
        )
        headings = ("force", *(f"displacement along {axis}" for axis in _AXES))
        yield Table(
            headings, matrix, title="Cartesian stiffness [N/µm]" + (" and its standard uncertainty" if known else "")
        )
    if found.principal:
        principal = tuple(
            (
                _vector(one.direction),
                f"{np.rad2deg(one.direction_uncertainty):.2g}" if np.isfinite(one.direction_uncertainty) else UNKNOWN,
                _said(one.compliance, _MICRO),
                _stiffness(one),
            )
            for one in found.principal
        )
        headings = ("principal direction", "its u [°]", "compliance [nm/N]", "stiffness [N/µm]")
        yield Table(headings, principal, title="Principal directions, the softest first")


def _twists(runs: Sequence[TwistRun], places: Sequence[TwistPlace]) -> Iterator[Table]:
    """Twist at the greatest load of every run, and per force over all runs."""
    components = [*(f"{axis} [µm]" for axis in _AXES), *(f"{axis} [µrad]" for axis in "ABC")]
    scale = np.array([UM] * 3 + [_MICRO] * 3)
    rows = []
    for run in runs:
        step = run.greatest
        said = [significant(float(value), 4) for value in step.twist * scale]
        suspect = "none" if run.twist.suspect is None else str(run.twist.suspect)
        rows.append((run.run, f"{step.force:.4g}", *said, suspect))
    yield Table(("run", "force [N]", *components, "suspect"), tuple(rows), title="Twist of the tool at the greatest load")
    if places:
        per = np.array([_MICRO] * 3 + [_NANO] * 3)
        slopes = tuple(
            (
                _place(place),
                _vector(place.direction),
                str(len(place.runs)),
                *(_said(estimate, per[k]) for k, estimate in enumerate(place.compliance)),
            )
            for place in places
        )
        per_force = (*(f"{axis} [nm/N]" for axis in _AXES), *(f"{axis} [nrad/N]" for axis in "ABC"))
        yield Table(("place", "direction", "runs", *per_force), slopes, (0, 1), "Twist per force, all runs")


def key_values(found: StaticResults) -> tuple[KeyValue, ...]:
    """The numbers of the first screen: compliance of each place, or the principal ones, or the twist per force."""
    values: list[KeyValue] = []
    for place in found.places:
        if place.line is not None:
            values.append(
                KeyValue("compliance", _said(place.line.compliance, _MICRO), "nm/N", f"straight line, {_place(place)}")
            )
        loops = [run for run in place.runs if run.hysteresis is not None]
        for run in loops[:1]:
            assert run.hysteresis is not None
            hysteresis = _of_cycles(run.hysteresis.mean_hysteresis, UM)
            values.append(KeyValue("mean hysteresis", hysteresis, "µm", f"run {run.run}"))
    if found.cartesian is not None:
        names = ("softest", "middle", "stiffest")
        for name, one in zip(names, found.cartesian.principal, strict=False):
            along = f"principal direction {_vector(one.direction)}"
            values.append(KeyValue(f"{name} compliance", _said(one.compliance, _MICRO), "nm/N", along))
    for twisted in found.twist_places[:1]:
        units = ("nm/N",) * 3 + ("nrad/N",) * 3
        for k, estimate in enumerate(twisted.compliance[:KEY_VALUES]):
            scale = _MICRO if k < 3 else _NANO
            values.append(
                KeyValue(f"twist per force, {'XYZABC'[k]}", _said(estimate, scale), units[k], f"{len(twisted.runs)} runs")
            )
    return tuple(values[:KEY_VALUES])


def hysteresis_figure(found: StaticResults) -> Figure | None:
    """Displacement over the force of every run, and its departure from the secant, where a loop shows; None without runs.

    A run without a full cycle is drawn with the others of its place about their straight line.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    panels: list[tuple[str, list[LoadedRun], LoadedPlace]] = []
    for place in found.places:
        panels += [(run.run, [run], place) for run in place.runs if run.hysteresis is not None]
        rest = [run for run in place.runs if run.hysteresis is None]
        if rest:
            panels.append((rest[0].run if len(rest) == 1 else f"{len(rest)} runs without a full cycle", rest, place))
    if not panels:
        return None
    with needs_report_extra():
        from elastogeo.report.drawing.style import grid, house_style
    with house_style():
        figure, axes = grid(2 * len(panels), 2, 2.5)
        for k, (title, runs, place) in enumerate(panels):
            _panel(axes[2 * k], axes[2 * k + 1], runs, place)
            axes[2 * k].set_title(title + (", simulated" if found.joints.test.simulated else ""))
            axes[2 * k + 1].set_title("less the secant")
            if runs[0].hysteresis is None:
                axes[2 * k + 1].set_title("less the straight line")
        labels = {label: handle for ax in axes for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)}
        figure.legend(labels.values(), labels.keys(), loc="outside lower center", ncols=4)
    return figure


def _panel(left: Axes, right: Axes, runs: Sequence[LoadedRun], place: LoadedPlace) -> None:
    """Readings, branches and secant: as they are, and less the secant."""
    from elastogeo.report.drawing.style import BLUE, GREY, INK, ORANGE

    force = np.concatenate([run.force for run in runs])
    read = np.concatenate([run.displacement for run in runs])
    loop = runs[0].hysteresis
    ends = np.array(loop.range if loop is not None else (force.min(), force.max()))
    secant = np.zeros(2)
    name = "secant"
    curves: list[tuple[str, str, Array, Array]] = []
    if loop is not None:
        secant = np.array([loop.middle(float(end)).value for end in ends])
        grid = np.linspace(ends[0], ends[1], _CURVE)
        rows = loop.curves.shape.rows(grid)
        curves = [
            ("rising", BLUE, grid, rows @ loop.curves.rising.mean(axis=0)),
            ("falling", ORANGE, grid, rows @ loop.curves.falling.mean(axis=0)),
        ]
    elif place.line is not None:
        secant, name = place.line.offset.value + place.line.compliance.value * ends, "straight line"
    for ax, less in ((left, False), (right, True)):

        def drawn(at: Array, values: Array, less: bool = less) -> Array:
            return UM * (values - (_on(at, ends, secant) if less else 0.0))

        every = max(1, len(force) // _POINTS)
        ax.plot(force[::every], drawn(force, read)[::every], ".", color=GREY, markersize=2.0, label="readings")
        for label, colour, at, values in curves:
            ax.plot(at, drawn(at, values), color=colour, label=label)
        ax.plot(ends, drawn(ends, secant), color=INK, linewidth=0.8, linestyle="--", label=name)
        ax.set_xlabel("force [N]")
        ax.set_ylabel("displacement [µm]" if not less else "departure [µm]")


def _on(at: Array, ends: Array, values: Array) -> Array:
    """The straight line through two points, beyond them as well."""
    slope = (values[1] - values[0]) / (ends[1] - ends[0]) if ends[1] > ends[0] else 0.0
    return np.asarray(values[0] + slope * (at - ends[0]))


def _said(estimate: Estimate | None, scale: float) -> str:
    return "" if estimate is None else _said_half(estimate.value, estimate.interval(), scale)


def _of_cycles(estimate: Estimate | None, scale: float) -> str:
    """A value with the standard uncertainty that the cycles of its run show: no interval, as they do not show other runs."""
    if estimate is None:
        return ""
    value = significant(estimate.value * scale, 4)
    return f"{value} (u {significant(estimate.standard_uncertainty * scale, 2)})" if estimate.known else value


def _said_half(value: float, interval: Sequence[float], scale: float) -> str:
    """`value ± U`; the value alone where nothing shows its uncertainty."""
    if isfinite(value) and not isfinite(interval[1] - interval[0]):
        return significant(value * scale, 4)
    return value_with_uncertainty(value * scale, (interval[1] - interval[0]) / 2 * scale)


def _stiffness(soft: StaticLine | Principal | OnAxisPart) -> str:
    """Stiffness in N/µm, with its uncertainty; unknown where the compliance may as well be zero."""
    try:
        return _said(soft.stiffness(), 1 / UM)
    except UnsupportedError:
        return UNKNOWN


def _place(place: LoadedPlace | TwistPlace) -> str:
    return " ".join(f"{axis}{value:.4g}" for axis, value in sorted(place.commands.items()))


def _vector(direction: Array) -> str:
    return "(" + ", ".join(f"{component:.3f}" for component in direction) + ")"
