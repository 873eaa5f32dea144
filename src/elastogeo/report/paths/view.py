"""The view of a prediction along a path: how far the tool is off, where, and by what."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.prediction import DEVIATION_COMPONENTS, PathPrediction
from elastogeo.report.numbers import pretty
from elastogeo.report.paths.document import path_json
from elastogeo.report.paths.rows import (
    block_rows,
    extremes,
    main_component,
    said_um,
    split_rows,
    worst_by_force,
    worst_point,
)
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SPLIT = (
    "Geometry is what the machine is off without a load, compliance what loads do to it; spindle side and workpiece side "
    "are the same sum by where it arises. A part that the tests do not tell from another "
    "is not stated, although their sum is."
)


_DATUM = {"machine": "where the machine says", "probed": "where the machine's own probe finds it along the path, unloaded"}


@views(PathPrediction)
def path_view(found: PathPrediction) -> View:
    """All that is shown of a prediction along a path."""
    document = path_json(found)
    extreme, split, blocks = _extremes(found), _split(found), _blocks(found)
    tables = tuple(table for table in (extreme, split, blocks) if table.rows)
    return View(
        kind="Tool path",
        title=found.path.machine.name,
        subtitle=f"{found.path.name}, predicted from {found.name}",
        origin=f"From tests that were simulated: {found.simulated}" if found.simulated else "",
        head=_head(found),
        sentence=f"{_answer(found)} {attention_sentence(found.verdict)}",
        values=tuple(_values(found)),
        picture=_picture(
            "plan",
            "The path, coloured by the predicted deviation; thin, where the tool really goes, magnified. Dotted: not "
            "supported by these tests.",
            "Plan view of the tool path, coloured by deviation",
            "plan_figure",
            found,
        ),
        checks=said(found.verdict),
        document=document,
        rows=document["points"],
        tables=tables,
        sections=tuple(_sections(found, extreme, split, blocks)),
    )


def _sections(found: PathPrediction, extreme: Table, split: Table, blocks: Table) -> Iterator[Section]:
    way = _picture(
        "way",
        "Predicted deviation along the way with its 95 % interval.",
        "Deviation along the path, with its band",
        "way_figure",
        found,
    )
    yield Section("Along the path", pictures=(way,), tables=(extreme,) if extreme.rows else ())
    if found.parts and split.rows:
        parts = _picture(
            "split",
            "What each part adds. Above: geometry, compliance and tool; below: by the side of the machine.",
            "The parts of the deviation along the path",
            "split_figure",
            found,
        )
        yield Section("By what", (_SPLIT,), (parts,), (split,))
    if blocks.rows:
        yield Section("By block", tables=(blocks,))


def _head(found: PathPrediction) -> tuple[tuple[str, str], ...]:
    path, machine = found.path, found.path.machine
    blocks = len(np.unique(path.block))
    several = f", {blocks} blocks" if blocks > 1 else ""
    return (
        ("Machine", f"{machine.name}, {machine.topology.compact} {machine.topology.iso}"),
        ("Known from", found.name),
        ("Path", f"{path.name}: {len(path)} points, {path.travelled[-1]:.1f} mm{several}"),
        ("Force on the tool", found.force or "none"),
        ("Tool and holder", found.tool or "count as rigid"),
        ("Normal", f"positive to the {found.normal_to} of the travel"),
        ("Workpiece sits", _DATUM[found.datum]),
    )


def _answer(found: PathPrediction) -> str:
    at = worst_point(found)
    if at is None:
        return f"These tests do not support where the tool goes along this path{_by_force(found)}."
    k = main_component(found)
    where = "normal to the path" if DEVIATION_COMPONENTS[k] == "normal" else f"in {DEVIATION_COMPONENTS[k]}"
    told = pretty(said_um(float(found.value[at, k]), float(found.expanded[at, k])))
    part = "" if found.supported[:, :3][found.asked[:, :3]].all() else ", where the tests support it"
    return f"The tool will be off by up to {told} µm {where}, {found.path.travelled[at]:.1f} mm along the path{part}."


def _by_force(found: PathPrediction) -> str:
    """What the force does, where that is all that is known."""
    worst = worst_by_force(found)
    if worst is None:
        return ""
    k_at, k = worst
    part, where = found.parts["compliance"], "normal to it" if DEVIATION_COMPONENTS[k] == "normal" else f"in {'xyz'[k]}"
    told = pretty(said_um(float(part.value[k_at, k]), float(part.expanded[k_at, k])))
    return f"; what loads do to the machine they do: up to {told} µm {where}"


def _values(found: PathPrediction) -> Iterator[KeyValue]:
    at, k = worst_point(found), main_component(found)
    if at is None:
        return
    name = "normal to the path" if DEVIATION_COMPONENTS[k] == "normal" else f"in {DEVIATION_COMPONENTS[k]}"
    yield KeyValue(
        f"greatest, {name}",
        pretty(said_um(float(found.value[at, k]), float(found.expanded[at, k]))),
        "µm",
        f"at {found.path.travelled[at]:.1f} mm of the way",
    )
    for one in extremes(found):
        if one.component != DEVIATION_COMPONENTS[k]:
            yield KeyValue(
                f"in {one.component}", f"{pretty(one.least)} to {pretty(one.greatest)}", "µm", "least to greatest"
            )


def _extremes(found: PathPrediction) -> Table:
    return Table(
        ("component", "least ± U [µm]", "at [mm]", "greatest ± U [µm]", "at [mm]"),
        tuple((r.component, pretty(r.least), r.least_at, pretty(r.greatest), r.greatest_at) for r in extremes(found)),
        title="Deviation of the tool along the axes of the workpiece, and normal to the path",
        note=f"U is half the 95 % interval. The normal counts to the {found.normal_to} of the travel.",
    )


def _split(found: PathPrediction) -> Table:
    return Table(
        ("part", "x ± U [µm]", "y ± U [µm]", "z ± U [µm]", "normal ± U [µm]"),
        tuple((name, *map(pretty, cells)) for name, *cells in split_rows(found)) if found.parts else (),
        title="What it is made of, where it is greatest",
        strong=(len(found.parts),),
    )


def _blocks(found: PathPrediction) -> Table:
    return Table(
        ("block", "at [mm]", "greatest ± U [µm]", "force [N]"),
        tuple((block, at, pretty(value), force) for block, at, value, force in block_rows(found)),
        words=(),
        title="The blocks where the tool is off most",
    )


def _picture(name: str, caption: str, alternative: str, figure: str, found: PathPrediction) -> Picture:
    return Picture(name, caption, alternative, partial(_drawn, figure, found))


def _drawn(figure: str, found: PathPrediction) -> Figure:
    drawing: Figure = getattr(import_module("elastogeo.report.paths.figures"), figure)(found)
    return drawing
