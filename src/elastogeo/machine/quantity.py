"""Quantities with the unit they have inside: what the field of a setting means, for people and for the readers of files.

To Python these are plain numbers; the unit rides along as an annotation, so that a file's `radius_um` or `radius_m` can be
converted once, at the boundary, and refused when it is no length. A setting that may be left out is written `Length | None`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

MM_OR_RAD = "mm|rad"

Length = Annotated[float, "mm"]
Angle = Annotated[float, "rad"]
Force = Annotated[float, "N"]
Mass = Annotated[float, "kg"]
"""Inside in N s^2/mm: 1 kg is 1e-3 of it."""

Pressure = Annotated[float, "bar"]
Feed = Annotated[float, "mm_s"]
Point = Annotated[tuple[float, float, float], "mm"]
Point2 = Annotated[tuple[float, float], "mm"]
Resolution = Annotated[float, MM_OR_RAD]
RotationVector = Annotated[tuple[float, float, float], "rad"]
Travel = Annotated[tuple[float, float], MM_OR_RAD]
Pitch = Annotated[float, MM_OR_RAD]
PerLength = Annotated[float, "mm_per_mm"]
Targets = Annotated[tuple[float, ...], MM_OR_RAD]
Temperature = Annotated[float, "degC"]
Time = Annotated[float, "s"]
Rate = Annotated[float, "rad_s"]
Frequency = Annotated[float, "Hz"]
Current = Annotated[float, "A"]
Forces = Annotated[tuple[float, ...], "N"]
Pressures = Annotated[tuple[float, ...], "bar"]
LengthPerPressure = Annotated[float, "mm_per_bar"]
LengthPerForce = Annotated[float, "mm_per_N"]
AxisCommands = Annotated[Mapping[str, float], MM_OR_RAD]
"""Commands by axis letter: each in mm or rad, as the axis is linear or rotary."""

TorquePerCurrent = Annotated[float, "N_mm_per_A"]
ForcePerCurrent = Annotated[float, "N_per_A"]
Inertia = Annotated[float, "N_mm_s2"]
Damping = Annotated[float, "N_mm_s_per_rad"]
Torque = Annotated[float, "N_mm"]
Lengths = Annotated[tuple[float, ...], "mm"]
LengthsPerForce = Annotated[tuple[float, ...], "mm_per_N"]
