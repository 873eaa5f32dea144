"""A stepped cantilever against its printed value, a numerical integral of its bending line, and energy."""

import numpy as np
import pytest

from elastogeo.errors import InputError
from elastogeo.machine import HeldTool, ToolSection, cantilever, measured_tool

MILL = [ToolSection(26.0, 9.6, 600e3), ToolSection(19.0, 12.0, 600e3)]


def test_the_printed_deflection_comes_out() -> None:
    """100 N on 26 mm of 9.6 mm and 45 mm in all of 12 mm, 600 GPa: 0.00635633 mm."""
    assert 100 * cantilever(MILL).matrix[0, 0] == pytest.approx(0.00635633, abs=5e-9)


def test_it_is_the_bending_line_integrated_in_small_steps() -> None:
    """From the clamping, where it neither moves nor turns, in 45000 steps of curvature M / (E I)."""
    x = (np.arange(45000) + 0.5) / 45000 * 45.0  # from the tip
    bending = np.where(x < 26.0, 600e3 * np.pi * 9.6**4 / 64, 600e3 * np.pi * 12.0**4 / 64)
    step = 45.0 / 45000
    for load, moment in (("force", x), ("moment", np.ones_like(x))):
        curvature = moment / bending
        turn, deflection = float(np.sum(curvature) * step), float(np.sum(curvature * x) * step)
        C = cantilever(MILL).matrix
        found = (C[0, 0], -C[4, 0]) if load == "force" else (-C[0, 4], C[4, 4])
        assert found == pytest.approx((deflection, turn), rel=1e-6)


def test_a_tip_pushed_in_x_turns_so_that_the_tool_stays_in_its_clamping() -> None:
    """The point at the clamping, 45 mm above the tip, is moved by the rotation back to where it was, to first order."""
    C = cantilever([ToolSection(45.0, 10.0, 600e3)]).matrix
    for across, about, sign in ((0, 4, 1.0), (1, 3, -1.0)):
        assert C[across, across] + sign * C[about, across] * 45.0 == pytest.approx(C[across, across] * (1 - 1.5))


def test_no_load_gains_energy() -> None:
    C = cantilever(MILL).matrix
    assert np.array_equal(C, C.T)
    assert np.linalg.eigvalsh(C).min() > 0


def test_what_was_measured_is_taken_as_it_is() -> None:
    tool = measured_tool(1e-4, 2e-5, 0.1)
    assert tool.matrix[[0, 1, 2], [0, 1, 2]].tolist() == [1e-4, 1e-4, 2e-5]
    assert np.count_nonzero(tool.matrix) == 3


def test_what_is_no_tool_is_refused() -> None:
    with pytest.raises(InputError, match="a tool has at least one section"):
        cantilever([])
    with pytest.raises(InputError, match="0 mm thick"):
        ToolSection(26.0, 0.0, 600e3)
    with pytest.raises(InputError, match="not symmetric, as reciprocity wants it"):
        HeldTool(np.triu(np.ones((6, 6))))
    with pytest.raises(InputError, match="neither may be negative"):
        measured_tool(-1e-4)
    with pytest.raises(InputError, match="relative uncertainty of the tool is 20; it is a share"):
        measured_tool(1e-4, 0.0, 20.0)
