"""What a test is read from: exactly the files that its reader opens, and the hash that tells it from others."""

import shutil
from pathlib import Path

import pytest

from elastogeo.errors import FormatError
from elastogeo.formats import calibration_text, read_with_files
from elastogeo.formats.documents.calibrations import CalibrationDocument
from elastogeo.observe import Calibration
from tests.history.intake.small_tests import write_test

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted(
    folder
    for kind in ("test.toml", "drive.toml")
    for folder in ROOT.glob(f"examples/*/{kind}")
    if "umich" not in str(folder)
)


def laid_out(found, folder: Path) -> Path:
    """The files of a test alone, in another place."""
    home = folder / "a" / "b" / "c" / "d"
    home.mkdir(parents=True)
    for said, (place, _) in found.files.items():
        to = home / said
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(place, to)
    return home


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.parent.name)
def test_the_files_of_every_example_alone_make_the_same_test(file, tmp_path):
    found = read_with_files(file)
    again = read_with_files(laid_out(found, tmp_path))
    assert again.sha256 == found.sha256
    assert list(again.files) == list(found.files)
    assert again.test == found.test


def test_machine_and_calibration_files_are_among_them(tmp_path):
    shutil.copyfile(ROOT / "src/elastogeo/formats/machines/hermle_c50.toml", tmp_path / "mill.toml")
    setup = 'calibration = "../gauge.toml"'
    folder = write_test(tmp_path / "t", machine="../mill.toml", setup=setup)
    gauge = CalibrationDocument(force=Calibration((1.0, 6.0), (112.0, 742.0)))
    (tmp_path / "gauge.toml").write_text(calibration_text(gauge))
    found = read_with_files(folder)
    assert set(found.files) == {"test.toml", "runs/36N.csv", "runs/742N.csv", "../gauge.toml", "../mill.toml"}


def test_a_renamed_copy_is_the_same_and_strays_do_not_count(tmp_path):
    first = read_with_files(write_test(tmp_path / "one")).sha256
    shutil.copytree(tmp_path / "one", tmp_path / "two words é")
    (tmp_path / "two words é" / "report.pdf").write_bytes(b"%PDF")
    (tmp_path / "two words é" / "runs" / "old.csv").write_bytes(b"angle_deg,radial_um\n0,1\n")
    assert read_with_files(tmp_path / "two words é").sha256 == first
    (tmp_path / "one" / "test.toml").rename(tmp_path / "one" / "march.toml")
    assert read_with_files(tmp_path / "one" / "march.toml").sha256 == first


@pytest.mark.parametrize("name", ["test.toml", "runs/36N.csv"])
def test_one_changed_bit_is_another(name, tmp_path):
    folder = write_test(tmp_path / "one")
    first = read_with_files(folder).sha256
    data = bytearray((folder / name).read_bytes())
    data[data.index(b"2000") if name == "test.toml" else len(data) - 2] ^= 1  # one digit becomes another
    (folder / name).write_bytes(data)
    assert read_with_files(folder).sha256 != first


@pytest.mark.parametrize("inside", [True, False])
def test_a_file_named_by_its_place_on_this_computer_is_refused(inside, tmp_path):
    """A copy laid out elsewhere would read the first one's file, or none."""
    folder = write_test(tmp_path / "one")
    place = folder / "runs" / "36N.csv" if inside else tmp_path / "36N.csv"
    shutil.move(folder / "runs" / "36N.csv", place)
    text = (folder / "test.toml").read_text()
    (folder / "test.toml").write_text(text.replace('"runs/36N.csv"', f'"{place.as_posix()}"'))
    with pytest.raises(FormatError, match="by its place on this computer; copy it beside the test"):
        read_with_files(folder)


def test_a_file_far_above_is_refused(tmp_path):
    folder = write_test(tmp_path / "a" / "b" / "c" / "d" / "one")
    shutil.move(folder / "runs" / "36N.csv", tmp_path / "36N.csv")
    text = (folder / "test.toml").read_text()
    (folder / "test.toml").write_text(text.replace("runs/36N.csv", "../../../../../36N.csv"))
    with pytest.raises(FormatError, match="more than 3 folders above its own"):
        read_with_files(folder)


@pytest.mark.parametrize(
    ("made", "message"),
    [
        ({}, "holds no test.toml and no drive.toml; elastogeo new writes one"),
        ({"test.toml": "", "drive.toml": ""}, "holds test.toml and drive.toml; name the one that is meant"),
        ({"test.toml": 'schema = "elastogeo.machine/1"'}, "is no test; its schema is 'elastogeo.machine/1'"),
        ({"test.toml": "x ="}, "is no TOML"),
    ],
)
def test_what_is_no_test_is_refused(made, message, tmp_path):
    for name, text in made.items():
        (tmp_path / name).write_text(text)
    with pytest.raises(FormatError, match=message):
        read_with_files(tmp_path)


def test_a_path_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(FormatError, match="is not there; check the path"):
        read_with_files(tmp_path / "nothing")
