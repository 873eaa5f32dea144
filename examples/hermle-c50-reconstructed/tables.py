"""The printed tables of the thesis that hold its real loaded ball-bar test, as they are printed.

B. Beglarzadeh, Metrology of machine tool compliance under quasi-static condition, Polytechnique Montreal, Tables 5.7, 5.8
and 4.7. Strings, because a printed figure says by its last digit how well it is known.
"""

FORCES = (36, 238, 364, 490, 616, 742)
"""Force levels [N] of the local estimates; the run at 112 N is in none of them."""

PRESSURES = (0.4, 2, 3, 4, 5, 6)
"""Of these levels [bar]."""

SET_UP_DEFLECTION = 2.33e-3
"""Of the set-up [mm/bar] (Eq. 5.38): in the readings of chapter 4, subtracted from those of chapter 5."""

COMPLIANCES = ("C_XXX", "C_XYX", "C_YYY", "C_CXY", "C_CYY", "C_CCY")
GEOMETRY = ("E_XX1", "E_YX2", "E_XY2", "E_YY1", "E_C(0Y)X", "E_Xt0", "E_Yt0")

TABLE_5_7 = (
    ("6.15E-05", "-1.65E-06", "4.64E-05", "8.04E-08", "-2.79E-08", "-2.88E-09"),
    ("6.28E-05", "1.07E-06", "4.72E-05", "-6.94E-08", "3.13E-09", "-1.92E-09"),
    ("6.54E-05", "5.54E-07", "4.94E-05", "-6.03E-08", "-3.11E-08", "-1.38E-09"),
    ("6.37E-05", "2.56E-06", "4.74E-05", "-3.67E-08", "-2.60E-08", "-1.08E-09"),
    ("6.60E-05", "2.48E-06", "4.92E-05", "-7.63E-08", "1.24E-08", "-8.76E-10"),
)
"""Local compliances [mm/N, rad/N, rad/(N mm)] of adjacent levels."""

TABLE_5_8 = (
    ("-0.00012", "2.75E-07", "-7.66E-07", "-9.36E-05", "3.71E-06", "0.004438", "5.29E-05"),
    ("-0.00013", "4.91E-07", "-7.79E-07", "-9.91E-05", "-6.08E-07", "0.004025", "0.00030"),
    ("-0.00014", "5.27E-07", "-6.77E-07", "-0.00011", "6.41E-07", "0.003821", "-0.00036"),
    ("-0.00014", "5.01E-07", "-6.68E-07", "-0.00010", "-5.91E-06", "0.003525", "-0.00093"),
    ("-0.00015", "7.19E-07", "-8.15E-07", "-0.00011", "-5.58E-06", "0.003413", "-0.00155"),
)
"""Local geometry [mm/mm, mm/mm^2, rad, mm] of adjacent levels. Two figures are printed as 0.0003 and -0.0001: like all of
their columns they have five decimals."""

TABLE_4_7 = (
    ("7.31E-05", "-9.09E-07", "5.79E-05", "3.87E-08", "-1.92E-08", "-3.21E-11"),
    ("7.47E-05", "-4.09E-07", "5.93E-05", "7.72E-09", "-1.87E-08", "-2.29E-11"),
    ("7.58E-05", "8.50E-08", "6.03E-05", "-5.12E-09", "-2.09E-08", "-2.52E-11"),
    ("7.68E-05", "5.49E-07", "6.10E-05", "-1.54E-08", "-1.78E-08", "-9.59E-12"),
)
"""Local compliances of adjacent differences to 36 N, from (238, 364) N on; the table's first pair has the run at 112 N."""


def half_unit(printed: str) -> float:
    """Half a unit of the last digit of a printed figure."""
    mantissa, _, exponent = printed.partition("E")
    return 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
