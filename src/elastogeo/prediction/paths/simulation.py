"""A cut on a machine whose faults are known: where the tool really goes, by exact products of transforms.

The judge of predictions: it shares the drivers with them (which load acts where), and none of their linear columns.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from elastogeo.machine import Array, Cut, ToolPath
from elastogeo.prediction.paths.deviation import Piece
from elastogeo.prediction.virtual import virtual_observations
from elastogeo.sources import exact_points, parameter_values


def simulated_points(
    truth: Mapping[str, float], path: ToolPath, cut: Cut | None = None, centre: Array | None = None
) -> Array:
    """Where the tool really goes, shape (m, 3) [mm], in the frame of the workpiece as it really stands.

    The loads are those of the nominal pose; what they cause may have any size. Less `path.points`, it is the error of the
    cut; of a compensated path, less the points that were meant.

    Parameters
    ----------
    truth : mapping of str to float
        Parameters of the machine by name; those of a set-up do not count.
    path : ToolPath
        With the commands that are really sent.
    cut : Cut, optional
    centre : array, shape (n,) [mm, rad], optional
        From which laws of travel count, if it is not the zero of every axis.
    """
    values = parameter_values(path.machine, truth)
    cut = cut or Cut()
    found = np.empty((len(path), 3))
    for part in path.slices():
        piece = Piece(path, cut, part)
        rotation, wrench = piece.rotation, piece.wrench
        turned = np.hstack([np.einsum("kij,kj->ki", rotation, half) for half in (wrench[:, :3], wrench[:, 3:])])
        asked = virtual_observations(path.machine, path.commands[part], np.zeros(6), turned, path.tool)
        asked = replace(asked, velocity=path.velocity[part], acceleration=None, sense=path.sense[part], weight=cut.workpiece)
        asked = asked if centre is None else replace(asked, centre=centre)
        found[part] = exact_points(values, path.machine, asked) + piece.tool_deflection()[:, :3]
    return found
