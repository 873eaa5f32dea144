"""Path and cut files: units are converted once, and what is wrong is refused with what to do."""

from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import FormatError, InputError
from elastogeo.formats import read_forces
from elastogeo.machine import ConstantForce, MeasuredForce, MillingForce

MILLING = """\
schema = "elastogeo.cut/1"
normal_to = "right"

[milling]
diameter_mm = 12
teeth = 4
helix_deg = 30
depth_mm = 2
width_mm = 3
speed_rpm = 6000
material = "Al7075-T6"
relative_uncertainty = 0.15

[tool]
relative_uncertainty = 0.2
sections = [
    { length_mm = 26, diameter_mm = 9.6, modulus_GPa = 600 },
    { length_mm = 19, diameter_mm = 12, modulus_N_mm2 = 600e3 },
]

[workpiece]
mass_kg = 80
centre_mm = [0, 0, 60]
"""


def written(folder: Path, text: str, name: str = "cut.toml") -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def test_a_cut_file_says_mill_tool_and_workpiece(tmp_path: Path) -> None:
    cut = eg.read_cut(written(tmp_path, MILLING))
    assert isinstance(cut.force, MillingForce)
    assert cut.force.speed == pytest.approx(200 * np.pi)
    assert cut.force.engagement.entry == pytest.approx(np.radians(120))
    assert cut.force.relative_uncertainty == 0.15
    assert cut.tool is not None
    assert 100 * cut.tool.matrix[0, 0] == pytest.approx(0.00635633, abs=5e-9)
    assert cut.workpiece is not None
    assert cut.workpiece.mass == pytest.approx(0.08)
    assert cut.normal_to == "right"


def test_own_coefficients_and_a_measured_tool(tmp_path: Path) -> None:
    text = MILLING.replace('material = "Al7075-T6"', "tangential_N_mm2 = 1800\ntangential_edge_N_per_mm = 25")
    text = text[: text.index("[tool]")] + "[tool]\nacross_um_per_N = 0.1\n"
    cut = eg.read_cut(written(tmp_path, text))
    assert isinstance(cut.force, MillingForce)
    assert (cut.force.edge.tangential, cut.force.edge.tangential_edge) == (1800.0, 25.0)
    assert cut.tool is not None
    assert cut.tool.matrix[1, 1] == pytest.approx(1e-4)


def test_forces_are_constant_or_of_a_file_beside(tmp_path: Path) -> None:
    head = 'schema = "elastogeo.cut/1"\n[force]\n'
    cut = eg.read_cut(written(tmp_path, head + 'constant_N = [0, 200, -50]\nalong = "path"\n'))
    assert cut.force == ConstantForce((0.0, 200.0, -50.0), "path")
    written(tmp_path, "way_mm,force_x_kN,force_y_N\n0,0.1,5\n10,0.2,7\n", "dyno.csv")
    cut = eg.read_cut(written(tmp_path, head + 'file = "dyno.csv"\non = "workpiece"\n'))
    assert isinstance(cut.force, MeasuredForce)
    assert cut.force.counts == "way"
    assert cut.force.on == "workpiece"
    assert cut.force.force.tolist() == [[100, 5, 0], [200, 7, 0]]


def test_a_cut_that_will_not_do_is_refused(tmp_path: Path) -> None:
    for text, kind, why in (
        (MILLING + "[force]\nconstant_N = [1, 2, 3]\n", FormatError, "the force comes from one of the two"),
        (MILLING.replace("Al7075-T6", "cheese"), InputError, "no cutting force coefficients of 'cheese'"),
        (MILLING.replace("width_mm = 3", "width_mm = 30"), InputError, "radial depth of cut is 30 mm"),
        (MILLING.replace("helix_deg", "helix_mm"), FormatError, "helix_mm has the unit 'mm'; write for example helix_rad"),
        (MILLING.replace('"right"', '"up"'), InputError, "the normal points to 'up'; write left or right"),
        ('schema = "elastogeo.cut/1"\n[force]\n', InputError, "says constant_N = .* one of the two"),
        ('schema = "elastogeo.cut/1"\n[force]\nconstant_N = [1, 2]\n', InputError, "holds 2 numbers; a force has three"),
    ):
        with pytest.raises(kind, match=why):
            eg.read_cut(written(tmp_path, text))


def test_a_path_is_axis_commands_or_tool_points(tmp_path: Path) -> None:
    machine = eg.read_machine("hermle_c50")
    commands = written(tmp_path, "command_x_mm,command_c_deg,feed_mm_min,block\n0,0,600,1\n10,90,600,2\n", "commands.csv")
    path = eg.read_path(commands, machine, zero={"Y": 20.0})
    assert path.commands[:, machine.index("X")].tolist() == [0, 10]
    assert path.commands[:, machine.index("C")] == pytest.approx([0, np.pi / 2])
    assert path.commands[:, machine.index("Y")].tolist() == [20, 20]
    assert path.timed
    points = written(tmp_path, "x_um,y_mm\n0,0\n10000,0\n10000,5\n", "points.csv")
    path = eg.read_path(points, machine, zero={"X": 100.0})
    assert path.commands[:, machine.index("X")] == pytest.approx([100, 110, 110])
    assert not path.timed


def test_a_path_is_a_program(tmp_path: Path) -> None:
    """A slot of 20 mm, a quarter of a circle after a rapid move; the table of words above is no program."""
    text = "%\nO0001 (SLOT)\nG21 G90 G17\nG0 X0 Y0 Z0\nG1 X20 F600\nG0 X50\nG3 X40 Y10 I-10 J0 F300\nM30\n%\n"
    path = eg.read_path(written(tmp_path, text, "slot.nc"), eg.read_machine("hermle_c50"), zero={"Z": -50.0}, step=2.0)
    assert np.ptp(path.commands[:, 4]) == 0
    assert path.commands[0, 4] == -50
    assert len(set(path.block.tolist())) == 2
    assert path.speed[[0, -1]] == pytest.approx([10.0, 5.0])


def test_a_table_that_is_no_path_is_refused(tmp_path: Path) -> None:
    machine = eg.read_machine("hermle_c50")
    for text, why in (
        ("angle_deg,radial_um\n0,1\n1,2\n", "a column 'angle', which no path has"),
        ("feed_mm_min\n600\n600\n", "no column of a path"),
        ("x_mm,command_y_mm\n0,0\n1,1\n", "axis commands .command_y. and tool points .x.; take one of the two out"),
        ("x_mm,block\n0,1\n1,1.5\n", "the column 'block' holds 1.5; count blocks"),
        ("x_mm\n0\n", "at least two points that differ"),
        ("x,y,z\n0,0,0\n1,1,1\n", "line 1: 3 column headers .*:\n  column 'x' has no unit: write x_mm"),
        ("XPOS,YPOS\n0,0\n1,1\n", "begins with b'XPOS,.*, which is no NC program, and no table .*; a path has .*x_mm, y_mm"),
        ("0,0,0\n1,1,1\n", "begins with b'0,0,0.*, which is no NC program, and no table .*; a path has .*x_mm, y_mm"),
        ("%PDF-1.7", "is a PDF, a page for people"),
    ):
        with pytest.raises(InputError, match=why):
            eg.read_path(written(tmp_path, text, "path.csv"), machine)
    with pytest.raises(InputError, match="has no column of forces but x; forces are columns force_x_N"):
        read_forces(written(tmp_path, "x_mm\n0\n1\n", "none.csv"))
    with pytest.raises(InputError, match=r"begins with b'FX,FY.*, which is no table .*; forces are columns force_x_N"):
        read_forces(written(tmp_path, "FX,FY\n0,0\n1,1\n", "dyno.csv"))
    with pytest.raises(InputError, match="has no axis 'U'"):
        eg.read_path(written(tmp_path, "command_x_mm\n0\n9\n", "path.csv"), machine, zero={"U": 1.0})
