"""A virtual reading against J C J^T computed from the Jacobian, on machines of several topologies."""

import numpy as np
import pytest

from elastogeo.formats import read_machine
from elastogeo.machine import jacobian
from elastogeo.prediction import functionals, parameter_scales, unsupported_share, virtual_observations
from elastogeo.sources import select_sources


@pytest.mark.parametrize("name", ["hermle_c50", "huron_kx8"])
def test_unit_loads_give_the_compliance_at_the_tool(name: str) -> None:
    machine = read_machine(name)
    random = np.random.default_rng(4)
    commands = random.uniform(-0.5, 0.5, (7, len(machine.axes)))
    sources = select_sources(machine, ["C_???"])
    values = random.normal(size=len(sources))
    J = jacobian(machine, commands)
    C = np.zeros((6 * len(machine.axes),) * 2)
    for source, value in zip(sources, values, strict=True):
        at = 6 * machine.axes.index(source.site[1])
        C[at + source.component, at + (source.load or 0)] = value
    expected = J @ C @ J.transpose(0, 2, 1)
    unit = np.eye(6)
    for d, f in [(0, 0), (2, 1), (4, 3)]:
        found = functionals(sources, machine, virtual_observations(machine, commands, unit[d], unit[f]))
        assert found @ values == pytest.approx(expected[:, d, f], rel=1e-9)


def test_scales_are_in_the_units_of_the_parameters() -> None:
    machine = read_machine("hermle_c50")
    scales = parameter_scales(select_sources(machine, ["C_XXX", "C_CXX", "C_CCX"]))
    assert sorted(scales, reverse=True) == pytest.approx([5e-6, 5e-6 / 300, 5e-6 / 300**2])


def test_what_is_seen_is_supported_and_what_is_not_is_not() -> None:
    seen = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
    asked = np.array([[3.0, 4.0, 0.0], [0.0, 0.0, 1.0], [0.0, 3.0, 4.0], [0.0, 0.0, 0.0]])
    assert unsupported_share(asked, seen, np.ones(3)) == pytest.approx([0.0, 1.0, 0.8, 0.0])
