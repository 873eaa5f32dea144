from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.text.units import UNITS, check_unit, from_internal, split_unit, to_internal


@pytest.mark.parametrize(
    ("header", "expected"),
    [
        ("angle_deg", ("angle", "deg")),
        ("angle [deg]", ("angle", "deg")),
        ("Angle (deg)", ("angle", "deg")),
        ("angle[°]", ("angle", "°")),
        ("feed_mm_min", ("feed", "mm_min")),
        ("feed [mm/min]", ("feed", "mm/min")),
        ("moment_N_mm", ("moment", "N_mm")),
        ("torque [N m]", ("torque", "N m")),
        ("Radial error [µm]", ("radial_error", "µm")),
        ("radial_μm", ("radial", "μm")),
        ("time_min", ("time", "min")),
        ("displacement_nm", ("displacement", "nm")),
        ("moment_Nm", ("moment", "Nm")),
        ("level", ("level", "")),
        ("level [-]", ("level", "")),
        ("mm", ("mm", "")),
    ],
)
def test_header_splits_into_quantity_and_unit(header: str, expected: tuple[str, str]) -> None:
    assert split_unit(header) == expected


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ("angle [grad]", "unit 'grad' of column .* is not known: use length: mm, um"),
        ("", "names no quantity"),
        ("_mm", "names no quantity"),
        ("radial [um] raw", "cannot be understood: write for example 'radial"),
    ],
)
def test_header_that_cannot_be_split_is_refused(header: str, message: str) -> None:
    with pytest.raises(FormatError, match=message):
        split_unit(header)


@pytest.mark.parametrize("quantity", ["radial", "force", "force_x", "force2", "x", "time"])
def test_quantity_of_the_field_needs_a_unit(quantity: str) -> None:
    with pytest.raises(FormatError, match=f"column '{quantity}' has no unit: write {quantity}_"):
        check_unit(quantity, "")


def test_quantity_with_a_unit_of_another_dimension_is_refused() -> None:
    with pytest.raises(FormatError, match=r"'force' has the unit bar \(pressure\): write force_N or force_kN"):
        check_unit("force", "bar")


@pytest.mark.parametrize(("quantity", "unit"), [("level", ""), ("force_level", ""), ("position", "deg"), ("xray", "")])
def test_other_names_and_fitting_units_pass(quantity: str, unit: str) -> None:
    check_unit(quantity, unit)


@pytest.mark.parametrize(
    ("value", "unit", "internal"),
    [
        (35, "um", 0.035),
        (35, "nm", 3.5e-5),
        (2, "m", 2000),
        (1, "in", 25.4),
        (180, "deg", pi),
        (3600, "arcsec", pi / 180),
        (1, "mrad", 1e-3),
        (0.742, "kN", 742),
        (1, "Nm", 1000),
        (250, "kPa", 2.5),
        (0.25, "MPa", 2.5),
        (1, "min", 60),
        (3, "ms", 0.003),
        (1000, "mm_min", 1000 / 60),
        (3, "m/min", 50),
        (20, "degC", 20),
        (7, "", 7),
    ],
)
def test_known_conversions_are_the_nearest_double(value: float, unit: str, internal: float) -> None:
    assert to_internal([value], unit)[0] == internal


@settings(derandomize=True)
@given(st.floats(-1e9, 1e9), st.sampled_from(sorted(UNITS)))
def test_back_and_forth_agrees_to_the_last_digits(value: float, unit: str) -> None:
    assert from_internal(to_internal([value], unit), unit)[0] == pytest.approx(value, rel=1e-15, abs=1e-300)


def test_values_are_never_rounded() -> None:
    values = np.array([0.1 + 2**-55, 1e-17, -0.0])
    assert to_internal(values, "mm").tobytes() == values.tobytes()


@pytest.mark.parametrize("convert", [to_internal, from_internal])
def test_unknown_unit_is_refused(convert: type) -> None:
    with pytest.raises(FormatError, match="unit 'furlong' is not known"):
        convert([1.0], "furlong")
