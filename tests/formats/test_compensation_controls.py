"""Each control's files against what its maker's public texts print, and against a reader that others wrote."""

import re

import numpy as np
import pyLSV2
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import compensation_text, read_back
from elastogeo.formats.compensation_files import compensation_formats
from elastogeo.machine import ErrorTable

FORMATS = compensation_formats()


def table(position, value, axis="X", component="X"):
    value = np.array(value, dtype=float)
    both = value if value.ndim == 2 else np.column_stack([value, value])
    return ErrorTable(axis, component, np.array(position, dtype=float), both, np.full(both.shape, np.nan))


def read(control, text, **settings):
    return FORMATS[control].read(text.encode(), "f", FORMATS[control].with_defaults(settings))


class TestLeadscrew:
    """The layout of the function manual: 801 points from -200 to 600 at 1 mm; a positive value moves the axis in its
    negative direction, so that it is the error."""

    def test_the_manuals_table(self):
        bent = table([-200.0, 0.0, 600.0], [0.003, 0.0, -0.004])
        lines = compensation_text([bent], "sinumerik-lec", {"step": "1"})["eec.ini"].decode().splitlines()
        assert lines[:3] == ["%_N_AX_EEC_INI", "CHANDATA(1)", "$AA_ENC_COMP[0,0,X1]=0.003000"]
        assert "$AA_ENC_COMP[0,800,X1]=-0.004000" in lines
        assert "$AA_ENC_COMP[0,801,X1]" not in "".join(lines)
        assert lines[-5:-1] == [
            "$AA_ENC_COMP_STEP[0,X1]=1.000000",
            "$AA_ENC_COMP_MIN[0,X1]=-200.000000",
            "$AA_ENC_COMP_MAX[0,X1]=600.000000",
            "$AA_ENC_COMP_IS_MODULO[0,X1]=0",
        ]
        assert lines[-1] == "M17"

    def test_backlash_is_positive_where_the_axis_falls_short(self):
        short = table([0.0, 100.0], [[-0.002, 0.003], [-0.001, 0.004]])
        text = compensation_text([short], "sinumerik-lec", {"system": "1", "axes": "X=AX7"})["eec.ini"].decode()
        assert "$MA_BACKLASH[1,AX7]=0.005000\n" in text
        assert "$AA_ENC_COMP[1,0,AX7]=0.000500\n" in text

    def test_degrees_of_a_rotary_axis(self):
        turn = table(np.deg2rad([0.0, 90.0]), np.deg2rad([0.0, 0.001]), "C", "C")
        text = compensation_text([turn], "sinumerik-lec", {"step": "90"})["eec.ini"].decode()
        assert "$AA_ENC_COMP[0,1,C1]=0.001000\n" in text
        assert "$AA_ENC_COMP_MAX[0,C1]=90.000000\n" in text

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            (("STEP[0,X1]=100", "STEP[0,X1]=50"), "X has 2 points where MIN, MAX and STEP make 3; correct them"),
            (("$AA_ENC_COMP_MAX[0,X1]=100.000000\n", ""), "X has no STEP above zero, no MIN or no MAX; add what is missing"),
            (("X1]", "Q9]"), "has the axis Q9, which is none of X1, Y1, Z1, A1, B1, C1; say axes"),
            (("CHANDATA(1)", "R1=2"), r"f, line 2: 'R1=2' is nothing that leadscrew error compensation has"),
            (("=0.003000", "=three"), r"f, line 3: a value is 'three', which is no number"),
            (("M17\n", ""), "f: does not end with M17 on a line of its own; it may be cut off, copy it again"),
        ],
    )
    def test_what_does_not_fit_is_refused(self, change, message):
        text = compensation_text([table([0.0, 100.0], [0.003, 0.0])], "sinumerik-lec", {"step": "100"})["eec.ini"].decode()
        with pytest.raises(FormatError, match=message):
            read("sinumerik-lec", text.replace(*change))


class TestSag:
    """The manual's example counts 17 points from -400 to 400 at 50; the sign is a setting."""

    def test_one_axis_by_another(self):
        sag = table([-400.0, 400.0], [0.0, 0.01], "Y", "X")
        lines = compensation_text([sag], "sinumerik-cec", {"step": "50"})["cec.ini"].decode().splitlines()
        assert lines[:3] == ["%_N_NC_CEC_INI", "CHANDATA(1)", "$AN_CEC[0,0]=0.000000"]
        assert lines[18:] == [
            "$AN_CEC[0,16]=0.010000",
            "$AN_CEC_INPUT_AXIS[0]=(AX2)",
            "$AN_CEC_OUTPUT_AXIS[0]=(AX1)",
            "$AN_CEC_STEP[0]=50.000000",
            "$AN_CEC_MIN[0]=-400.000000",
            "$AN_CEC_MAX[0]=400.000000",
            "$AN_CEC_DIRECTION[0]=0",
            "$AN_CEC_MULT_BY_TABLE[0]=0",
            "$AN_CEC_IS_MODULO[0]=0",
            "M17",
        ]

    def test_directions_take_a_table_each_and_the_sign_is_turned_at_will(self):
        play = table([0.0, 100.0], [[-0.002, 0.003], [-0.001, 0.004]], "X", "Y")
        settings = {"step": "100", "sign": "correction", "first": "4"}
        text = compensation_text([play], "sinumerik-cec", settings)["cec.ini"].decode()
        assert re.findall(r"DIRECTION\[(\d)\]=(\S+)", text) == [("4", "1"), ("5", "-1")]
        assert "$AN_CEC[4,0]=0.002000\n" in text
        assert read_back({"cec.ini": text.encode()}, "sinumerik-cec", settings)[0].value == pytest.approx(play.value)

    def test_more_tables_than_the_control_has_are_refused(self):
        one = table([0.0, 100.0], [[0.0, 0.1], [0.0, 0.1]])
        with pytest.raises(InputError, match="1 errors take 2 tables, and the control has 1; choose fewer, or say tables"):
            compensation_text([one], "sinumerik-cec", {"tables": "1"})
        with pytest.raises(InputError, match="takes 201 points, and the control has 200; choose a step of"):
            compensation_text([one], "sinumerik-cec", {"step": "0.5"})

    def test_a_product_of_tables_is_not_read(self):
        text = compensation_text([table([0.0, 1.0], [0.0, 1.0])], "sinumerik-cec")["cec.ini"].decode()
        with pytest.raises(FormatError, match="table 0 is multiplied by another, which is not read"):
            read("sinumerik-cec", text.replace("MULT_BY_TABLE[0]=0", "MULT_BY_TABLE[0]=2"))
        with pytest.raises(FormatError, match="table 0 lacks INPUT_AXIS; add it"):
            read("sinumerik-cec", text.replace("$AN_CEC_INPUT_AXIS[0]=(AX1)\n", ""))

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            (("MAX[0]=1.0", "MAX[0]=3.0"), "f: table 0 has 2 points where MIN, MAX and STEP make 4; correct them"),
            (("STEP[0]=1.0", "STEP[0]=0.0"), "f: table 0 has 2 points where MIN, MAX and STEP make 0; correct them"),
            (("CHANDATA(1)", "R1=2"), "f, line 2: 'R1=2' is nothing that sag compensation has; take it out"),
            (("M17\n", ""), "f: does not end with M17 on a line of its own; it may be cut off, copy it again"),
        ],
    )
    def test_what_does_not_fit_is_refused(self, change, message):
        text = compensation_text([table([0.0, 1.0], [0.0, 1.0])], "sinumerik-cec", {"step": "1"})["cec.ini"].decode()
        with pytest.raises(FormatError, match=re.escape(message)):
            read("sinumerik-cec", text.replace(*change))


class TestHeidenhain:
    """`[axis of the .COM column] = F(axis of the .CMA column)`: Z by Y and Y by Y stand in the table of Y."""

    tables = (
        table([0.0, 10.0], [[-0.005, 0.002], [-0.004, 0.003]], "Y", "Y"),
        table([0.0, 10.0], [0.001, 0.002], "Y", "Z"),
    )

    def test_the_layout(self):
        files = compensation_text(self.tables, "heidenhain", {"step": "10"})
        assert files["Y.COM"].decode() == (
            "BEGIN Y.COM MM\n"
            "NR    AXISPOS      BACKLASH     Y            Z\n"
            "0     +0.0000      +0.0020      -0.0050      +0.0010\n"
            "1     +10.0000     +0.0030      -0.0040      +0.0020\n"
            "[END]\n"
        )
        assert files["CONFIG.CMA"].decode().splitlines()[1].split() == ["NR", "ACTIVE", "Y"]
        assert files["CONFIG.CMA"].decode().splitlines()[2].split() == ["0", "*", "Y.COM"]

    def test_another_reader_finds_the_same_numbers(self, tmp_path):
        for name, content in compensation_text(self.tables, "heidenhain", {"step": "10"}).items():
            (tmp_path / name).write_bytes(content)
        found = pyLSV2.NCTable.parse_table(tmp_path / "Y.COM")
        assert (found.name, found.suffix) == ("Y", "com")
        assert [{key: float(value) for key, value in row.items()} for row in found.rows] == [
            {"NR": 0.0, "AXISPOS": 0.0, "BACKLASH": 0.002, "Y": -0.005, "Z": 0.001},
            {"NR": 1.0, "AXISPOS": 10.0, "BACKLASH": 0.003, "Y": -0.004, "Z": 0.002},
        ]
        assert pyLSV2.NCTable.parse_table(tmp_path / "CONFIG.CMA").rows[0]["Y"].strip() == "Y.COM"

    def test_what_another_writer_wrote_is_read(self, tmp_path):
        """Written by pyLSV2 from its own columns, which are wider than ours."""
        made = pyLSV2.NCTable(name="X", suffix="COM", has_unit=True, is_metric=True)
        for name, start, end in (("NR", 0, 8), ("AXISPOS", 8, 24), ("X", 24, 40)):
            made.append_column(name, start, end)
        for k, (place, value) in enumerate([(-100.0, -0.005), (0.0, 0.0)]):
            made.append_row({"NR": str(k), "AXISPOS": f"{place:+.4f}", "X": f"{value:+.4f}"})
        made.dump_native(tmp_path / "X.COM")
        found = FORMATS["heidenhain"].read((tmp_path / "X.COM").read_bytes(), "X.COM", {"sign": "error"})[0]
        assert found.position == pytest.approx([-100.0, 0.0])
        assert found.value[:, 0] == pytest.approx([-0.005, 0.0])
        assert found.one_sided

    def test_what_is_no_table_is_refused(self):
        text = compensation_text(self.tables, "heidenhain", {"step": "10"})["Y.COM"].decode()
        with pytest.raises(FormatError, match="there is no column AXISPOS; its columns are NR, POSITION"):
            read("heidenhain", text.replace("AXISPOS ", "POSITION"))
        with pytest.raises(FormatError, match="the column Q is no axis; take it out"):
            read("heidenhain", text.replace("            Z", "            Q"))


class TestFanuc:
    """The example of the parameter manual: reference point 40, interval 50 mm, 400 mm to the negative side: points 33 to 49
    hold +2 +1 +1 -2 0 -1 0 -1 +2 +1 0 -1 -1 -2 0 +1 +2."""

    increments = (2, 1, 1, -2, 0, -1, 0, -1, 2, 1, 0, -1, -1, -2, 0, 1, 2)
    correction = (0, 2, 3, 4, 2, 2, 1, 1, 0, 2, 3, 3, 2, 1, -1, -1, 0, 2)
    """What they sum to from the reference position, at -400, -350, ... 450 mm: the manual draws it."""

    def example(self):
        return table(np.arange(-400.0, 451.0, 50.0), -1e-3 * np.array(self.correction))

    def test_the_manuals_example(self):
        text = compensation_text([self.example()], "fanuc", {"step": "50"})["pitch.txt"].decode()
        points = re.findall(r"^N1(\d{4})P(\S+)$", text, re.MULTILINE)
        assert [(int(number), int(value)) for number, value in points] == list(
            zip(range(33, 50), self.increments, strict=True)
        )
        parameters = dict(re.findall(r"^N0(\d{4})A1P(\S+)$", text, re.MULTILINE))
        assert parameters == {"3620": "40", "3621": "33", "3622": "49", "3623": "1", "3624": "50000"}
        assert text.startswith("%\n")
        assert text.endswith("\n%\n")
        back = read_back({"pitch.txt": text.encode()}, "fanuc", {})[0]
        assert back.value[:, 0] == pytest.approx(self.example().value[:, 0], abs=1e-12)

    def test_rounding_does_not_add_up(self):
        """A scale of 4.4 um over 100 intervals of 0.044 um each: every increment is 0 or 1, their sum 4."""
        fine = table(np.linspace(0, 100, 101), np.linspace(0, -0.0044, 101))
        text = compensation_text([fine], "fanuc", {"step": "1"})
        assert read_back(text, "fanuc", {})[0].value[-1, 0] == pytest.approx(-0.004)

    def test_both_directions_differ_by_parameter_3627_at_the_reference(self):
        lost = table([-100.0, 0.0, 100.0], [[-0.003, 0.001], [-0.002, 0.002], [-0.001, 0.003]])
        text = compensation_text([lost], "fanuc", {"step": "100"})["pitch.txt"].decode()
        assert "N03605A1P1\n" in text
        assert "N03627A1P-4\n" in text
        back = read_back({"pitch.txt": text.encode()}, "fanuc", {})[0]
        assert back.value == pytest.approx(lost.value)
        one = read_back(compensation_text([lost], "fanuc", {"step": "100", "both": "no"}), "fanuc", {})[0]
        assert one.value == pytest.approx(np.repeat([[-0.001], [0.0], [0.001]], 2, axis=1), abs=1e-9)

    def test_magnification_and_limits(self):
        steep = table([0.0, 100.0], [0.0, 0.050])
        text = compensation_text([steep], "fanuc", {"step": "100", "magnification": "10", "largest": "7"})["pitch.txt"]
        assert b"N10041P-5\n" in text
        with pytest.raises(InputError, match=r"an increment is 50, and the control takes 7 at the most; choose .* of 8"):
            compensation_text([steep], "fanuc", {"step": "100", "largest": "7"})
        with pytest.raises(InputError, match="60 points lie before the reference point 40; say a greater reference"):
            compensation_text([table([-60.0, 0.0], [0.0, 0.01])], "fanuc", {"step": "1"})
        with pytest.raises(InputError, match="from the reference position it is 201 points, and the control has 128"):
            compensation_text([table([1900.0, 2000.0], [0.0, 0.01])], "fanuc", {"step": "10"})
        with pytest.raises(InputError, match="unit is 'small'; give the detection unit in mm"):
            compensation_text([steep], "fanuc", {"unit": "small"})

    def test_a_file_with_holes_is_refused(self):
        text = compensation_text([self.example()], "fanuc", {"step": "50"})["pitch.txt"].decode()
        with pytest.raises(FormatError, match="the points 41 are not there; write every point from end to end"):
            read("fanuc", text.replace("N10041P2\n", ""))
        with pytest.raises(FormatError, match="axis 1 lacks the parameters 3624; add them"):
            read("fanuc", text.replace("N03624A1P50000\n", ""))
        with pytest.raises(FormatError, match=r"f, line 3: 'N3620' is no parameter and no point"):
            read("fanuc", text.replace("N03621A1P33", "N3620"))


class TestVolumetric:
    """The layout of the maker's page: a header of argument and errors, blanks apart; errors in mm and rad, `#` between."""

    def test_errors_of_one_axis_share_a_header(self):
        tables = [
            table([0.0, 10.0], [0.02, 0.0]),
            table([0.0, 10.0], [4.2e-6, 1.1e-6], "X", "B"),
            table([0.0, 1.0], [0.0, 1e-3], "C", "C"),
        ]
        text = compensation_text(tables, "isg")["volumetric.csv"].decode()
        assert text == (
            "X EXX EBX\n0.000000 0.020000 0.000004200\n10.000000 0.000000 0.000001100\n#\n"
            "C ECC\n0.000000 0.000000000\n57.295780 0.001000000\n// end\n"
        )

    def test_comments_are_passed_over_and_other_headers_refused(self):
        assert read("isg", "// measured\nX EXX\n0 0.001\n// end\n")[0].value[0, 0] == 0.001
        with pytest.raises(FormatError, match="a block has no header of one axis and its errors"):
            read("isg", "X Y EXX\n0 0 0.001\n// end\n")
        with pytest.raises(FormatError, match="a row of X has not 2 values"):
            read("isg", "X EXX\n0 0.001 3\n// end\n")
        with pytest.raises(InputError, match="volumetric compensation: 2 records, and the control has 1; say records"):
            compensation_text([table([0.0, 1.0], [0.0, 1.0])], "isg", {"records": "1"})


class TestCsv:
    def test_uncertainties_are_kept_and_units_are_those_of_the_header(self):
        known = ErrorTable("X", "B", np.array([0.0]), np.array([[1e-6, 2e-6]]), np.array([[3e-7, np.nan]]))
        text = compensation_text([known], "csv")["errors.csv"].decode()
        assert "E_BX,X,B,+,0,mm,0.206264806,0.0618794419,arcsec\n" in text
        back = read_back({"errors.csv": text.encode()}, "csv", {})[0]
        assert back.uncertainty[0] == pytest.approx(known.uncertainty[0], nan_ok=True)

    def test_what_does_not_fit_is_refused(self):
        text = compensation_text([table([0.0], [1e-3])], "csv")["errors.csv"].decode()
        with pytest.raises(FormatError, match="f, line 2: positions in mm and deviations in mm; give mm and um"):
            read("csv", text.replace(",um", ",mm"))
        with pytest.raises(FormatError, match="E_XX has other positions in"):
            read("csv", text.replace("X,-,0,", "X,-,5,"))
        with pytest.raises(FormatError, match=r"line 2: .* has not the columns error,axis"):
            read("csv", text.replace("X,+,0,", "X,up,0,"))
