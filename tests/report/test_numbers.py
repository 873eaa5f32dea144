"""How numbers are written."""

from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from elastogeo.report import display_unit, significant, value_with_uncertainty
from elastogeo.report.text import combination


@pytest.mark.parametrize(
    ("value", "uncertainty", "text"),
    [
        (61.8983, 0.0314, "61.898 ± 0.031"),
        (61.8983, 0.0996, "61.90 ± 0.10"),
        (-1.10233, 0.0071, "-1.1023 ± 0.0071"),
        (0.0, 0.25, "0.00 ± 0.25"),
        (3.0, 120.0, "0 ± 120"),
        (123456.0, 1234.0, "123500 ± 1200"),
        (6.18983e-5, 3.14e-8, "(6.1898 ± 0.0031)e-05"),
        (6.18983e7, 3.14e5, "(6.190 ± 0.031)e+07"),
        (1.5, 0.0, "1.500000000 ± 0"),
        (0.0, 0.0, "0 ± 0"),
        (1.5, float("nan"), "1.500 ± not known"),
        (1.5, float("inf"), "1.500 ± not known"),
        (float("nan"), 1.0, "not known"),
    ],
)
def test_value_with_uncertainty(value: float, uncertainty: float, text: str) -> None:
    assert value_with_uncertainty(value, uncertainty) == text


@given(st.floats(-1e5, 1e5), st.floats(1e-2, 1e4))
def test_what_is_written_is_within_half_a_unit_of_the_last_place(value: float, uncertainty: float) -> None:
    written, half = value_with_uncertainty(value, uncertainty).split(" ± ")
    digits = Decimal(f"{uncertainty:.1e}")
    assert Decimal(half) == digits
    place = Decimal(1).scaleb(int(digits.as_tuple().exponent))
    assert abs(Decimal(written) - Decimal(repr(value))) <= place / 2


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (43.7001, 3, "43.7"),
        (0.14, 3, "0.140"),
        (9742.79, 3, "9740"),
        (1.2e-7, 3, "1.20e-07"),
        (0.0, 3, "0"),
        (-0.5, 2, "-0.50"),
    ],
)
def test_significant(value: float, digits: int, text: str) -> None:
    assert significant(value, digits) == text


@pytest.mark.parametrize(
    ("unit", "magnitude", "name", "factor"),
    [
        ("mm/N", 6.19e-5, "nm/N", 1e6),
        ("mm/N", 4e-3, "µm/N", 1e3),
        ("rad/N", 2.7e-8, "nrad/N", 1e9),
        ("rad/(N mm)", 1.1e-9, "nrad/(N·mm)", 1e9),
        ("mm/mm", 1.3e-4, "µm/m", 1e6),
        ("mm/mm^2", 4.08e-7, "µm/m²", 1e9),
        ("rad/mm", 2e-8, "µrad/m", 1e9),
        ("mm", 0.0039, "µm", 1e3),
        ("mm", 0.0, "mm", 1.0),
        ("mm/N", float("nan"), "mm/N", 1.0),
        ("mm/N", 1e-30, "fm/N", 1e12),
        ("s", 2.5, "s", 1.0),
        ("s", 3e-4, "µs", 1e6),
    ],
)
def test_display_unit(unit: str, magnitude: float, name: str, factor: float) -> None:
    shown = display_unit(unit, magnitude)
    assert shown.name == name
    assert shown.factor == pytest.approx(factor)


def test_combination() -> None:
    terms = {"C_XXX": 1.0, "C_XXY": 0.9999999999999991, "C_YYX": -0.5, "C_YYY": -1.0}
    assert combination(terms) == "C_XXX + C_XXY - 0.5000 C_YYX - C_YYY"
