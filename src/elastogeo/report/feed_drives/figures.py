"""The figures of identified feed drives: friction over speed, a run predicted from the others, the compared models."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elastogeo.drive import BalanceFit, DriveRecord, Motion, usable
from elastogeo.identification.feed_drives import AxisDrive, DriveIdentification
from elastogeo.report.drawing.style import BLUE, FAINT, GREY, INK, ORANGE, READABLE, SMALL, new_figure
from elastogeo.report.feed_drives.rows import identified

_QUANTITIES = {"A": "current", "N mm": "torque", "N": "force"}
_SHOWN = 300
"""Samples of a run that are shown: more would be a black band."""
_POINTS = 1500


def friction_figure(result: DriveIdentification) -> Figure:
    """Friction over velocity, an axis a panel."""
    axes = identified(result)
    figure = new_figure(0.3 + min(2.9, 7.2 / len(axes)) * len(axes), width=READABLE)
    for ax, found in zip(_panels(figure, len(axes)), axes, strict=True):
        _friction(ax, found, result.test.of(found.axis))
    return figure


def run_figure(result: DriveIdentification) -> Figure:
    """A run as recorded and as predicted, an axis a panel."""
    axes = identified(result)
    figure = new_figure(2.3 * len(axes))
    for ax, found in zip(_panels(figure, len(axes)), axes, strict=True):
        _run(ax, found, result.test.of(found.axis))
    return figure


def models_figure(result: DriveIdentification) -> Figure:
    """Error of every compared model, an axis a panel."""
    axes = [axis for axis in identified(result) if axis.models]
    figure = new_figure(0.6 + 0.24 * sum(len(axis.models) + 2 for axis in axes))
    for ax, found in zip(_panels(figure, len(axes)), axes, strict=True):
        _models(ax, found)
    return figure


def _panels(figure: Figure, count: int) -> list[Axes]:
    return list(np.atleast_1d(figure.subplots(count, 1)))


def _shown(found: AxisDrive) -> dict[str, BalanceFit]:
    """The first of the compared models, and the one that is shown, by name."""
    fits = {found.models[0].name: found.models[0].fit} if found.models else {}
    return fits if found.fit is None else {**fits, found.model: found.fit}


def _friction(ax: Axes, found: AxisDrive, records: Sequence[DriveRecord]) -> None:
    """Effort without that of the inertia over the velocity, and the laws."""
    fits = _shown(found)
    fit = next(iter(fits.values()))
    inertia = fit.determined.get("inertia", fit.known.get("inertia", 0.0))
    speed, effort = [], []
    for record in records:
        mask = usable(record, fit.model)
        speed.append(record.velocity[mask])
        effort.append((record.effort - inertia * record.acceleration)[mask])
    x, y = np.concatenate(speed), np.concatenate(effort)
    every = max(1, len(x) // _POINTS)
    ax.plot(x[::every], y[::every], ".", color=GREY, markersize=1.5, alpha=0.5, zorder=1, rasterized=True)
    curve = np.linspace(x.min(), x.max(), 801)
    for (name, law), colour, dash in zip(fits.items(), (BLUE, ORANGE), ("-", "--"), strict=False):
        balance = law.balance
        motion = Motion(curve, np.zeros_like(curve), law.model.smooth_speed, law.model.stribeck_speed)
        ax.plot(
            curve, np.hstack([t.columns(motion) for t in law.model.chosen]) @ balance.values, dash, color=colour, label=name
        )
    ax.set_ylim(*np.quantile(y, [0.002, 0.998]))
    ax.set_xlabel(f"velocity [{records[0].length_unit}/s]")
    ax.set_ylabel(f"{_quantity(found)} less inertia [{found.effort_unit}]")
    ax.set_title(f"{found.axis}: friction over velocity")
    ax.legend(loc="lower right")  # no friction drives its axis forward


def _quantity(found: AxisDrive) -> str:
    """What is recorded of the motor."""
    return _QUANTITIES.get(found.effort_unit, "effort")


def _run(ax: Axes, found: AxisDrive, records: Sequence[DriveRecord]) -> None:
    """Measured and predicted effort through a run of middling error."""
    scores = found.held_out or (found.left_out.scores if found.left_out else found.identified)
    score = sorted(scores, key=lambda s: s.rmse)[len(scores) // 2]
    record = next(r for r in records if r.run == score.run)
    busy = np.convolve(np.abs(record.velocity), np.ones(min(_SHOWN, len(record.time))), "valid")
    first = int(np.argmax(busy))
    part = slice(first, first + _SHOWN)
    ax.plot(record.time[part], record.effort[part], color=INK, linewidth=0.9, label="recorded")
    for (name, law), colour in zip(_shown(found).items(), (BLUE, ORANGE), strict=False):
        predicted = law.balance.effort(record)
        predicted[~usable(record, law.model)] = np.nan
        ax.plot(record.time[part], predicted[part], color=colour, linewidth=0.9, label=name)
    ax.set_ylabel(f"{_quantity(found)} [{found.effort_unit}]")
    ax.set_xlabel("time [s]")
    ax.set_title(f"{found.axis}: {record.run}")
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + (high - low) / 5)
    ax.legend(loc="upper left", ncols=3)


def _models(ax: Axes, found: AxisDrive) -> None:
    """Error at left-out runs of each model, the first one's as a line."""
    names = [model.name for model in found.models]
    errors = [model.left_out.rmse for model in found.models]
    colours = [FAINT if model.impossible else ORANGE if model.name == found.supported else BLUE for model in found.models]
    ax.barh(names, errors, color=colours, height=0.7)
    ax.axvline(errors[0], color=GREY, linewidth=0.8)
    for k, model in enumerate(found.models):
        said = f"{errors[k]:.3f}" + (f"  ({-100 * model.gain:+.1f} %)" if k else "")
        said += f"  negative {', '.join(model.impossible)}" if model.impossible else ""
        ax.text(max(errors), k, f" {said}", va="center", fontsize=SMALL)
    ax.set_xlim(0, 1.6 * max(errors))
    ax.invert_yaxis()
    ax.set_xlabel(f"RMSE at left-out runs [{found.effort_unit}]")
    ax.set_title(f"{found.axis}: models")
