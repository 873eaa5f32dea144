"""`elastogeo nc`: programs of planned tests, from the shell."""

import json

import pytest

import elastogeo as eg


@pytest.fixture
def bar(tmp_path, elastogeo):
    assert elastogeo("new", tmp_path / "bar", "--instrument", "ball-bar")[0] == 0
    return tmp_path / "bar"


@pytest.mark.parametrize("flavour", ["iso", "linuxcnc", "sinumerik", "heidenhain"])
def test_a_test_without_readings_gets_its_program(bar, elastogeo, tmp_path, flavour):
    code, out, err = elastogeo("nc", bar, "--flavour", flavour, "-o", tmp_path / "p", "--json")
    assert (code, err) == (0, "")
    (program,) = json.loads(out)["programs"]
    assert program["flavour"] == flavour
    assert program["minutes"] == pytest.approx(11.7, abs=0.05)
    assert eg.read_program(tmp_path / "p").extent()["X"] == (-150.0, 151.5)


def test_settings_come_in_the_units_of_their_names(bar, elastogeo, tmp_path):
    wanted = ("--start-deg", 90, "--overshoot-deg", 0, "--feed-in-mm", 2, "--decimals", 3, "--zero", "G57")
    assert elastogeo("nc", bar, "-o", tmp_path / "p.nc", *wanted)[0] == 0
    text = (tmp_path / "p.nc").read_text()
    assert "G57" in text
    assert "G0 X0.0 Y152.0" in text
    assert text.count("G3 X0.0 Y150.0 I0.0 J-150.0") == 3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--most-radius-mm", "100"), "has an arc of radius 150 mm, the limits are 0 and 100 mm"),
        (("--most-feed-mm-min", "500"), "has a feed of 1000 mm/min, the limit is 500 mm/min"),
        (("--flavour", "fanuc"), "there is no flavour 'fanuc' of programs; there are: "),
        (("--order", "any"), "the order of the runs is 'any'; write one of listed"),
        (("--overshoot-deg", "-5"), "the overshoot is -0.08727 rad; it must be 0 to a full turn"),
        (("--decimals", "0"), "decimals is 0; write 1 to 9"),
    ],
)
def test_what_cannot_be_is_one_error_and_writes_nothing(bar, elastogeo, tmp_path, options, message):
    code, out, err = elastogeo("nc", bar, "-o", tmp_path / "p.nc", *options)
    assert (code, out) == (2, "")
    assert message in err
    assert not (tmp_path / "p.nc").exists()
