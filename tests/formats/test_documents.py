"""Documents with units in their keys: what is read, and what is refused with one clear error."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import find_machine, read_machine, read_simulation, read_test, shipped_machines
from elastogeo.formats.text.toml_documents import build, read_document
from elastogeo.machine import Feed, Force, Length
from elastogeo.observe import Calibration, Circle, LoadedBallBar

CIRCLE = {"radius_mm": 150, "centre": {"X_mm": 1, "A_deg": 90}}


def test_every_spelling_of_a_unit_is_converted_once():
    spelled = [{"radius_mm": 150}, {"radius_um": 150_000}, {"radius_m": 0.15}, {"radius_in": 150 / 25.4}]
    assert [build(Circle, table, "f").radius for table in spelled] == pytest.approx([150.0] * 4, rel=1e-15)


def test_feed_compound_unit_and_axis_commands():
    table = {"feed_mm_min": 2000, "setup_deflection_um_per_bar": 2.33, "circle": CIRCLE}
    setup = build(LoadedBallBar, table, "f")
    assert setup.feed == pytest.approx(2000 / 60)
    assert setup.setup_deflection == pytest.approx(2.33e-3)
    assert setup.circle.centre == pytest.approx({"X": 1.0, "A": 1.5707963267948966})


@dataclass(frozen=True)
class Optional:
    length: Length | None = None
    calibration: Calibration | None = None


def test_the_unit_of_a_setting_that_may_be_left_out_is_seen():
    table = {"length_um": 5, "calibration": {"pressure_bar": [1, 6], "force_N": [112, 742]}}
    assert build(Optional, table, "f") == Optional(0.005, Calibration((1.0, 6.0), (112.0, 742.0)))
    assert build(Optional, {}, "f") == Optional()
    with pytest.raises(FormatError, match="length_N has the unit 'N'; write for example length_mm"):
        build(Optional, {"length_N": 5}, "f")


def test_a_calibration_table_is_read_as_tuples():
    assert build(Calibration, {"pressure_bar": [1, 6], "force_N": [112, 742]}, "f") == Calibration(
        (1.0, 6.0), (112.0, 742.0)
    )


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"radius": 150}, "radius has no unit; write for example radius_mm"),
        ({"radius_deg": 150}, "radius_deg has the unit 'deg'; write for example radius_mm"),
        ({"radius_furlong": 1}, "has the unit 'furlong'"),
        ({"radius_mm": "150"}, "radius_mm must be numbers, got '150'"),
        ({"radius_mm": True}, "radius_mm must be numbers, got True"),
        ({"radius_mm": [150]}, "radius: input should be a valid number"),
        ({"radius_mm": 150, "radius_um": 3}, "radius_um gives radius a second time"),
        ({"radius_mm": -1}, "the radius of the circle is -1 mm"),
        ({}, "radius_mm is missing"),
        ({"radius_mm": 1, "plane": "XX"}, "there is no plane 'XX'"),
        ({"radius_mm": 1, "plane": [[1, 0, 0], [1, 1, 0]]}, "must be orthogonal"),
        ({"radius_mm": 1, "centre": {"Q_mm": 0}}, "centre.Q_mm names no axis"),
        ({"radius_mm": 1, "centre": {"A_mm": 0}}, "centre.A_mm has the unit 'mm'; write for example A_rad"),
        ({"radius_mm": 1, "planes": "XY"}, "planes is not known; did you mean plane"),
    ],
)
def test_what_will_not_do_is_said_with_what_to_write(table, message):
    with pytest.raises(FormatError, match=message.replace("(", r"\(")):
        build(Circle, table, "f")


def test_all_that_is_wrong_is_said_at_once():
    with pytest.raises(FormatError, match="feed has no unit") as caught:
        build(LoadedBallBar, {"feed": 3, "circle": {"radius_deg": 1}, "tol_mm": [0, 0, 0]}, "my.toml, setup")
    text = str(caught.value)
    assert text.startswith("my.toml, setup:")
    assert all(part in text for part in ("feed has no unit", "circle.radius_deg", "tol_mm is not known"))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"a = = 1", r"is no TOML.*line 1"),
        (b"\xff\xfe\x00", "is no UTF-8 text"),
        (b"a = 1\na = 2", "is no TOML"),
        (b"[" * 100_000, "is no TOML"),
    ],
)
def test_a_document_that_is_no_toml_is_refused(tmp_path, content, message):
    (tmp_path / "x.toml").write_bytes(content)
    with pytest.raises(FormatError, match=message):
        read_document(tmp_path / "x.toml")


def test_a_document_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(FormatError, match="cannot be opened"):
        read_document(tmp_path / "none.toml")


def test_a_document_of_another_schema_is_refused(tmp_path):
    (tmp_path / "x.toml").write_text('schema = "elastogeo.test/9"')
    with pytest.raises(FormatError, match=r'begin the file with schema = "elastogeo.machine/1"'):
        read_machine(tmp_path / "x.toml")
    with pytest.raises(FormatError, match=r'begin the file with schema = "elastogeo.simulation/1"'):
        read_simulation(tmp_path / "x.toml")


def test_the_shipped_machines_are_those_of_the_thesis_and_say_what_is_assumed():
    machines = {name: read_machine(path) for name, path in shipped_machines().items()}
    assert {name: machine.topology.compact for name, machine in machines.items()} == {
        "hermle_c50": "wCAFYXZSt",
        "huron_kx8": "wCAYFXZt",
    }
    assert all(machine.assumed for machine in machines.values())


def test_a_machine_file_declares_places_that_give_way(tmp_path):
    text = 'topology = "wYFXt"\n[places.holder]\non = "tool"\noffset_m = [0, 0, -0.06]\n[places.post]\n'
    holder, post = read_machine(_machine(tmp_path, text + 'on = "workpiece"\ncarries_workpiece = false\n')).places
    assert (holder.name, holder.on, holder.offset) == ("holder", "tool", (0.0, 0.0, -60.0))
    assert (post.name, post.carries_workpiece, holder.carries_workpiece) == ("post", False, True)


def _machine(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "m.toml"
    path.write_text('schema = "elastogeo.machine/1"\nname = "m"\n' + text)
    return path


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('topology = "wYFXt"\n[axes.Z]\n', "axes.Z names no axis of wYFXt"),
        ('topology = "wYFXt"\n[axes.X]\ntravel_deg = [0, 1]', "travel_deg is no travel of the axis X; write travel_mm"),
        ('topology = "wCFXt"\n[axes.C]\ntravel_mm = [0, 1]', "travel_mm is no travel of the axis C; write travel_deg"),
        ('topology = "wYFXt"\n[axes.X]\noffset_mm = [0, 1]', "offset"),
        ('topology = "wYFXt"\naxes = 3', "axes"),
        ('topology = "wYFXt"\n[axes]\nX = 3', "must be a table"),
        ('topology = "wYYFXt"', "names the axis Y 2 times"),
        ("topology = true", "topology: input should be a valid string"),
        ('topology = "wYFXt"\n[places]\nholder = 3', "places.holder: must be a table"),
        ('topology = "wYFXt"\n[places.holder]\noffset_mm = [0, 0, 9]', "places.holder"),
        ('topology = "wYFXt"\n[places.holder]\non = "Z"', "place 'holder': it is on 'Z', which is no carriage of wYFXt"),
    ],
)
def test_a_machine_file_that_will_not_do_is_refused(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        read_machine(_machine(tmp_path, text))


def test_a_machine_file_is_found_beside_the_document_and_keeps_every_number(tmp_path):
    _machine(tmp_path, 'topology = "wYFXt"\ntool_um = [1, 2, 3]\n[axes.X]\noffset_mm = [1.5, 0, -2]\ntravel_m = [-1, 1]')
    machine = find_machine("m.toml", tmp_path)
    assert machine.tool == pytest.approx((0.001, 0.002, 0.003))
    assert machine.joints[1].offset == (1.5, 0.0, -2.0)
    assert machine.joints[1].travel == (-1000.0, 1000.0)
    with pytest.raises(FormatError, match=r"there is no machine 'nowhere'.*hermle_c50, huron_kx8"):
        find_machine("nowhere", tmp_path)


def test_a_test_without_runs_is_refused(tmp_path):
    (tmp_path / "test.toml").write_text(
        'schema = "elastogeo.test/1"\nname = "t"\nmachine = "hermle_c50"\ninstrument = "loaded-ball-bar"\nsetup = {}'
    )
    with pytest.raises(FormatError, match="names no run; add for each run"):
        read_test(tmp_path)


@dataclass(frozen=True, slots=True)
class Bar:
    feed: Feed = 1.0
    force: Force = 1.0
    name: str = ""


@pytest.mark.parametrize(
    ("key", "meant"),
    [("fed_mm_min", "feed_mm_min"), ("forse_kN", "force_kN"), ("fed", "feed_mm_s"), ("feeds_N", "feed_mm_s")],
)
def test_a_misspelt_key_is_named_with_the_unit_that_was_written(key: str, meant: str) -> None:
    with pytest.raises(FormatError, match=f"^f: {key} is not known; did you mean {meant}\\?"):
        build(Bar, {key: 1.0}, "f")
