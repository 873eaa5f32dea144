"""Design files: tables and TOML say the same, units are converted once, and what is wrong is named with its line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats import read_design
from elastogeo.formats.text.files_read import files_read

TABLE = """# from the drawing office
name,value,unit
C_XXX,12,nm/N
C_CXY,4e-3,urad/N
C_XCY,4,nm/(N m)
C_CCX,0.05,urad/(N m)
K_ZZZ,180,N/um
K_AAZ,25,N m/mrad
CL_YYholder,3e-6,mm/N
"""
VALUES = {
    "C_XXX": 12e-6,
    "C_CXY": 4e-9,
    "C_XCY": 4e-9,
    "C_CCX": 5e-11,
    "C_ZZZ": 1 / 180e3,
    "C_AAZ": 1 / 25e6,
    "CL_YYholder": 3e-6,
}


def written(folder: Path, text: str, name: str = "design.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("change", [("", ""), (",", ";"), (",", "\t"), ("\n", "\r\n")])
def test_a_table_is_read_whatever_separates_it(tmp_path: Path, change: tuple[str, str]) -> None:
    design = read_design(written(tmp_path, TABLE.replace(*change) if change[0] else TABLE))
    assert dict(design.values) == pytest.approx(VALUES)
    assert design.name == "design.csv"


def test_a_decimal_comma_is_read_where_another_mark_separates(tmp_path: Path) -> None:
    assert read_design(written(tmp_path, "name;value;unit\nC_XXX;1,5;nm/N\n")).values["C_XXX"] == pytest.approx(1.5e-6)


def test_toml_says_the_same_and_takes_matrices(tmp_path: Path) -> None:
    random = np.random.default_rng(2)
    root = random.normal(size=(6, 6)) / 3 + np.eye(6)
    scale = np.array([1e3, 1e3, 1e3, 1e5, 1e5, 1e5])
    stiffness = (root @ root.T) * np.outer(scale, scale)
    text = f"""schema = "elastogeo.design/1"
name = "FE, release 4"
relative_uncertainty = 0.1
[[values]]
name = "K_XXX"
value = 180
unit = "N/um"
[[matrices]]
at = "Z"
stiffness = {stiffness.tolist()}
[[matrices]]
at = "holder"
compliance = {np.linalg.inv(stiffness).tolist()}
"""
    design = read_design(written(tmp_path, text, "design.txt"))
    assert (design.name, design.relative_uncertainty) == ("FE, release 4", 0.1)
    assert design.values["C_XXX"] == pytest.approx(1 / 180e3)
    inverse = np.linalg.inv(stiffness)
    for name, at in (("C_XXZ", (0, 0)), ("C_XBZ", (0, 4)), ("C_CCZ", (5, 5)), ("CL_ABholder", (3, 4))):
        assert design.values[name] == pytest.approx(inverse[at], rel=1e-6)


HEAD = 'schema = "elastogeo.design/1"\n'
ROWS = [[float(i == j) for j in range(6)] for i in range(6)]
TILTED = [[2.0 * (i == 0 and j == 1) + (i == j) for j in range(6)] for i in range(6)]
GAINS = [[float(i == j) * (-1 if i == 2 else 1) for j in range(6)] for i in range(6)]


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("name,value,unit\nC_XXX,12\n", "line 2: 'C_XXX,12' is no entry"),
        ("name,value,unit\nC_XXX,twelve,nm/N\n", "line 2: .* is no entry"),
        ("name,value,unit\nC_XXX,nan,nm/N\n", "line 2: .* is no entry"),
        ("name,value,unit\nD_XXX,12,nm/N\n", "line 2: 'D_XXX' is no compliance or stiffness"),
        ("name,value,unit\nC_XXX,12,N/nm\n", "line 2: the unit 'N/nm' is no length per force; write for example nm/N"),
        ("name,value,unit\nC_CXX,12,nm/N\n", "line 2: the unit 'nm/N' is no angle per force; write for example urad/N"),
        ("name,value,unit\nK_XXX,12,nm/N\n", "the unit 'nm/N' is no force per length; write for example N/um"),
        ("name,value,unit\nK_XYX,12,N/um\n", "K_XYX is no stiffness on the diagonal"),
        ("name,value,unit\nK_XXX,0,N/um\n", "K_XXX is 0; it must be finite, and a stiffness positive"),
        ("name,value,unit\nC_XXX,1,nm/N\nK_XXX,1,N/um\n", "line 3: C_XXX was given before; keep one"),
        ("name,value,unit\n", "holds no compliance"),
        ("C_XXX,1,nm/N\n", "is no TOML"),
        (HEAD, "holds no compliance"),
        (HEAD + "relative_uncertainty = 10\n", "relative_uncertainty is 10; write 0.1 for 10 %"),
        (HEAD + '[[matrices]]\nat = "X"\n', "write compliance or stiffness, one of the two"),
        (HEAD + f'[[matrices]]\nat = "X"\nstiffness = {ROWS[:5]}\n', "6 rows of 6 finite numbers"),
        (HEAD + f'[[matrices]]\nat = "X"\nstiffness = {TILTED}\n', "the matrix is not symmetric"),
        (HEAD + f'[[matrices]]\nat = "X"\nstiffness = {GAINS}\n', "a load in some direction would gain energy"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, text: str, why: str) -> None:
    with pytest.raises(FormatError, match=why):
        read_design(written(tmp_path, text))


def test_what_is_no_text_or_too_large_is_refused(tmp_path: Path) -> None:
    binary, large = tmp_path / "b", tmp_path / "l"
    binary.write_bytes(b"\x00\x01\x02")
    large.write_bytes(b"#" * 1_000_001)
    with pytest.raises(FormatError, match="zero bytes"):
        read_design(binary)
    with pytest.raises(FormatError, match="larger than 1 MB"):
        read_design(large)
    with pytest.raises(FormatError, match="cannot be opened"):
        read_design(tmp_path / "none")


def test_a_file_is_opened_once_and_noted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A table and TOML: what is kept beside a result is what was read."""
    read = open
    seen: list[Path] = []

    def counted(file: Path, *given: object, **named: object) -> object:
        seen.append(Path(file))
        return read(file, *given, **named)  # type: ignore[call-overload]

    monkeypatch.setattr("builtins.open", counted)
    monkeypatch.setattr("io.open", counted)
    for text in (TABLE, HEAD + '[[values]]\nname = "K_XXX"\nvalue = 180\nunit = "N/um"\n'):
        path = written(tmp_path, text)
        seen.clear()
        with files_read() as found:
            read_design(path)
        assert seen == [path]
        assert list(found) == [path]
