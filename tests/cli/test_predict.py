"""`elastogeo predict`: from a test and a path to a report; what is refused at the door."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
TEST = str(ROOT / "examples" / "hermle-c50-reconstructed")

Elastogeo = Callable[..., tuple[int, str, str]]


@pytest.fixture
def slot(tmp_path: Path) -> str:
    angle = np.linspace(0, 2 * np.pi, 37)
    rows = [f"{60 * np.cos(a):.6f},{60 * np.sin(a):.6f},1000" for a in angle]
    file = tmp_path / "slot.csv"
    file.write_text("\n".join(["x_mm,y_mm,feed_mm_min", *rows, ""]), encoding="utf-8")
    return str(file)


def test_the_terminal_says_how_far_off_the_tool_will_be(elastogeo: Elastogeo, slot: str) -> None:
    code, out, _ = elastogeo("predict", TEST, "--path", slot, "--force", "0,-200,0", "--along", "path")
    assert code == 0
    assert "The tool will be off by up to" in out
    assert "µm normal to the path" in out
    assert "tool counted: Tool and holder count as rigid" in out


def test_json_and_report_come_of_one_cut_file(elastogeo: Elastogeo, slot: str, tmp_path: Path) -> None:
    cut = tmp_path / "cut.toml"
    cut.write_text(
        'schema = "elastogeo.cut/1"\n[milling]\ndiameter_mm = 12\nteeth = 4\ndepth_mm = 2\nspeed_rpm = 6000\n'
        'material = "Al7075-T6"\nrelative_uncertainty = 0.15\n[tool]\nacross_um_per_N = 0.05\n',
        encoding="utf-8",
    )
    code, out, _ = elastogeo("predict", TEST, "--path", slot, "--cut", cut, "--json", "--report", tmp_path / "report")
    document = json.loads(out)
    assert code == 0
    assert document["schema"] == "elastogeo.path-prediction/1"
    assert document["force"].startswith("milling model, 4 teeth of 12 mm")
    assert len(document["points"]) == 37
    files = {path.name for path in (tmp_path / "report").iterdir()}
    assert files >= {"report.html", "report.pdf", "report.json", "plan.svg", "way.svg", "split.svg"}


def test_the_zero_is_given_axis_by_axis_in_mm_and_degrees(elastogeo: Elastogeo, slot: str) -> None:
    """A table at C = 90 degrees has turned by -90 (ISO 841): the tool at (100, -50) is at (50, 100) along its axes."""
    zero = ("--zero", "X_mm=100", "--zero", "Y_mm=-50", "--zero", "C_deg=90")
    code, out, _ = elastogeo("predict", TEST, "--path", slot, *zero, "--json")
    first = json.loads(out)["points"][0]
    assert code == 0
    assert (first["x_mm"], first["y_mm"]) == pytest.approx((60 + 50, 100))


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (("--force", "1,two,3"), "--force is '1,two,3', neither a file nor numbers; write three in N"),
        (("--force", "1,2"), "three numbers in N, along x, y and z; 2 arrived"),
        (("--zero", "Q_mm=1"), "--zero names 'Q', which is no axis"),
        (("--zero", "X_mm=left"), "--zero of X is 'left'; give a number, as in X_mm=100"),
        (("--zero", "X_mm=nan"), "--zero of X is 'nan'; give a number, as in X_mm=100"),
        (("--zero", "X_mm"), "--zero is 'X_mm'; give a name and a value, as in X_mm=100"),
        (("--zero", "X_mm=1", "--zero", "X_mm=2"), "--zero gives X_mm twice; give it once"),
        (("--zero", "X=480"), "--zero is 'X=480'; name the axis with its unit, X_mm, as in X_mm=100"),
        (("--zero", "X_deg=480"), "--zero is 'X_deg=480'; name the axis with its unit, X_mm, as in X_mm=100"),
        (("--zero", "C_mm=30"), "--zero is 'C_mm=30'; name the axis with its unit, C_deg, as in X_mm=100"),
        (("--zero", "U_mm=1"), "has no axis 'U'"),
        (("--zero", "X_mm=480"), "the path needs X from 420 to 540 mm, its travel is -500 to 500 mm"),
    ],
)
def test_what_will_not_do_is_refused(elastogeo: Elastogeo, slot: str, arguments: tuple[str, ...], why: str) -> None:
    code, _, err = elastogeo("predict", TEST, "--path", slot, *arguments)
    assert code == 2
    assert why in err
