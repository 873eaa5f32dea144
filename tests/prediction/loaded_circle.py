"""One loaded circle at seven levels, simulated exactly on a machine with known faults, which the tests of paths share."""

from __future__ import annotations

from collections.abc import Sequence

import elastogeo as eg
from elastogeo.formats import example_test
from elastogeo.identification import Identification
from elastogeo.observe import Imperfection
from elastogeo.sources import simulate

TRUTH = {
    "C_XXX": 6.2e-5,
    "C_XYX": 1.1e-5,
    "C_YYY": 4.3e-5,
    "C_CXY": 4e-8,
    "C_CYY": -6e-8,
    "C_CCY": 2e-10,
    "E_XX1": -1.2e-4,
    "E_YX2": 2.2e-7,
    "E_XY2": -1.5e-7,
    "E_YY1": 1.8e-4,
    "E_C(0Y)X": 9e-5,
}
CONFOUNDED = ("planar-xy", "E_XX1", "E_YX2", "E_XY2", "E_YY1", "E_C(0Y)X")
"""Parameters of which a purely radial force shows C_XY + C_YX only."""


def identified(noise: float, parameters: Sequence[str] | None = None) -> Identification:
    """What the circle tells, read with noise [mm], its centre 10 um off along X."""
    test = simulate(eg.read_test(example_test()), {**TRUTH, "E_Xt0": 0.01}, Imperfection(noise=noise), seed=3)
    return eg.identify(test, parameters=parameters)
