"""The contract of compensation files, over all controls; and of each control the numbers that others measured or printed."""

import inspect
import re
import textwrap

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import compensation_files, compensation_text, read_back, read_compensation
from elastogeo.formats.compensation_files import compensation_formats
from elastogeo.formats.compensation_points import even_points
from elastogeo.machine import ErrorTable


def _registered_toy():
    """The recipe as it stands in the docstring, registered like any control."""
    text = inspect.getdoc(compensation_files)
    found = re.search(r"`compensations/toy\.py`::\n\n(.*?)\n\nWhat the contract asks", text, re.DOTALL)
    exec(compile(textwrap.dedent(found[1]), "compensations/toy.py", "exec"), {})


_registered_toy()
FORMATS = compensation_formats()
each_format = pytest.mark.parametrize("control", FORMATS)


ROUNDED = {"heidenhain": 5.1e-5, "fanuc": 1.1e-3}
"""How finely a control counts [mm], where it is coarser than a nanometre: four decimals; two rounded micrometres."""


def line(axis="X", component="X", slope=2e-5, reversal=0.0, points=9, far=200.0):
    """An error that any table holds exactly, however its points lie: a straight line, and a reversal that is the same
    everywhere; zero at zero, positive where the axis goes too far."""
    position = np.linspace(-far, far, points)
    value = slope * position[:, np.newaxis] + np.array([-reversal, reversal]) / 2
    return ErrorTable(axis, component, position, value, np.full(value.shape, 1e-4))


def everything():
    return [
        line("X", "X"),
        line("Y", "Y", -1e-5),
        line("X", "Y", 3e-5),
        line("Y", "X", 1e-5),
        line("Z", "Z", 4e-5),
        line("C", "C", 5e-6, far=2.0),
        line("X", "B", 1e-7),
    ]


def taken(control, tables):
    return [table for table in tables if not FORMATS[control].takes(table)]


@each_format
def test_what_is_written_is_read_back_with_the_sign_of_the_house(control):
    tables = taken(control, everything())
    assert tables
    back = {t.name: t for t in read_back(compensation_text(tables, control), control, {})}
    assert set(back) == {table.name for table in tables}
    for table in tables:
        low, high = table.span
        at = np.linspace(low, high, 41)
        rounding = 1.1e-9 if table.component == "B" else ROUNDED.get(control, 1.1e-6)
        assert back[table.name].at(at) == pytest.approx(table.at(at), abs=rounding), table.name


@each_format
def test_what_is_not_taken_is_refused_in_words(control):
    for table in everything():
        why = FORMATS[control].takes(table)
        if why:
            with pytest.raises(InputError, match=f"does not take {table.name}: {re.escape(why)}; leave it out"):
                compensation_text([table], control)


@each_format
def test_only_its_own_reader_knows_a_file(control):
    files = compensation_text(taken(control, everything()), control)
    claimed = {name: [other for other, one in FORMATS.items() if one.can_read(data)] for name, data in files.items()}
    assert {tuple(found) for found in claimed.values()} <= {(control,), ()}
    assert (control,) in {tuple(found) for found in claimed.values()}


@each_format
def test_a_file_is_read_whatever_its_name_and_cut_off_it_is_refused(control, tmp_path):
    table = taken(control, everything())[0]
    for data in compensation_text([table], control).values():
        if not FORMATS[control].can_read(data):
            continue
        path = tmp_path / "of-no-known-suffix"
        path.write_bytes(data)
        assert read_compensation(path)[0].name == table.name
        whole = data.rstrip()
        for end in range(0, len(whole), max(len(whole) // 60, 1)):
            with pytest.raises(FormatError):
                FORMATS[control].read(whole[:end], "f", FORMATS[control].with_defaults({}))


@each_format
def test_settings_are_named_and_checked(control):
    with pytest.raises(InputError, match="has no setting 'colour'; it has: "):
        compensation_text([line()], control, {"colour": "red"})
    for setting in FORMATS[control].settings:
        assert setting.meaning
        if setting.choices:
            assert setting.default in setting.choices
            with pytest.raises(InputError, match=f"{setting.name} is 'no such'; it may be"):
                FORMATS[control].with_defaults({setting.name: "no such"})


def test_an_unknown_control_names_those_there_are():
    with pytest.raises(InputError, match=r"no compensation files are known of a control 'abacus'; there are .*linuxcnc"):
        compensation_text([line()], "abacus")


def test_points_are_even_round_and_hold_the_table():
    points = even_points(line(points=5), 100, None)
    assert points[[0, -1]] == pytest.approx([-200.0, 200.0])
    assert np.diff(points) == pytest.approx(50.0)
    assert even_points(line(far=203.0), 100, 50.0)[[0, -1]] == pytest.approx([-250.0, 250.0])
    with pytest.raises(InputError, match="at a step of 1 takes 401 points, and the control has 100; choose"):
        even_points(line(), 100, 1.0)
    with pytest.raises(InputError, match="the step between points is 0; it must be positive"):
        even_points(line(), 100, 0.0)


class TestLinuxCNC:
    """Against what a run of the control gave: type 0 `100 100.020 100.030` sent the motor to 99.980 on the way up."""

    at_100 = ErrorTable("X", "X", np.array([100.0]), np.array([[0.020, 0.030]]), np.full((1, 2), np.nan))

    @pytest.mark.parametrize(
        ("kind", "row"), [("0", "100.000000 100.020000 100.030000"), ("1", "100.000000 -0.020000 -0.030000")]
    )
    def test_both_types(self, kind, row):
        text = compensation_text([self.at_100], "linuxcnc", {"type": kind})
        assert text["x.comp"].decode().splitlines()[0] == row
        assert text["joints.ini"].decode() == f"[JOINT_0]\nCOMP_FILE = x.comp\nCOMP_FILE_TYPE = {kind}\n"
        assert read_back(text, "linuxcnc", {"type": kind})[0].value == pytest.approx(self.at_100.value)

    def test_inches_and_degrees(self):
        inch = compensation_text([self.at_100], "linuxcnc", {"unit": "inch"})["x.comp"].decode()
        assert inch.startswith("3.937008 3.937795 3.938189\n")
        turn = ErrorTable("C", "C", np.deg2rad([90.0]), np.deg2rad([[0.001, 0.002]]), np.full((1, 2), np.nan))
        assert compensation_text([turn], "linuxcnc")["c.comp"].decode().startswith("90.000000 90.001000 90.002000\n")

    def test_more_than_256_points_are_thinned_and_joints_are_counted(self):
        many = line("Z", "Z", points=1000)
        text = compensation_text([many], "linuxcnc", {"joints": "XZ"})
        assert len(text["z.comp"].splitlines()) == 257
        assert b"[JOINT_1]" in text["joints.ini"]
        with pytest.raises(InputError, match="the joints are 'XY', and Z is none of them; say joints in their order"):
            compensation_text([many], "linuxcnc", {"joints": "XY"})

    def test_what_the_control_would_refuse_is_refused(self):
        read = FORMATS["linuxcnc"].read
        with pytest.raises(FormatError, match=r"f, line 2: the nominal positions must ascend"):
            read(b"1 0 0\n0 0 0\n# axis X, COMP_FILE_TYPE 1, mm, 2 points\n", "f", {})
        with pytest.raises(FormatError, match="after 1 points there is no line that says axis, type"):
            read(b"1 0 0\n", "f", {})
        rows = b"".join(b"%d 0 0\n" % k for k in range(257))
        with pytest.raises(FormatError, match="has 257 points, and the control reads 256"):
            read(rows + b"# axis X, COMP_FILE_TYPE 1, mm, 257 points\n", "f", {})
