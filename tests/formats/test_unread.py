"""Files that no reader takes: what they are and what to do, in one error."""

import io
import zipfile
from pathlib import Path

import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import read_log_bytes
from elastogeo.formats.run_files import read_run, read_run_bytes


def workbook(*members: str) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for member in members:
            archive.writestr(member, "x")
    return buffer.getvalue()


CONTAINERS = {
    r"is an Excel workbook \(xlsx\), which is not read; export the sheet as CSV": workbook(
        "[Content_Types].xml", "xl/workbook.xml"
    ),
    r"is an old Excel workbook \(xls\)": b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600),
    "is an archive; unpack it": workbook("run.csv"),
    "is a PDF": b"%PDF-1.7\n%\xe2\xe3\n",
}


@pytest.mark.parametrize("message", CONTAINERS)
def test_containers_are_named_and_never_shown_as_bytes(message: str) -> None:
    for read in (read_run_bytes, read_log_bytes):
        with pytest.raises(FormatError, match=f"^f: {message}") as caught:
            read(CONTAINERS[message], "f")
        assert "begins with b" not in str(caught.value)


LOGS = {
    "time_s,position_x_mm,current_x_A\n": "line 1 has the column headers time_s, position_x_mm, current_x_A, but no line of "
    "numbers follows; export the file again, with its data",
    "# a trace\n\nZeit;Strom X\n": "line 3 has the column headers Zeit, Strom X, but no line of numbers follows",
    "time_s,x_mm,current_x_A\n0,000,1,5,0,25\n0,002,1,6,0,5\n": "line 1 has the column headers time_s, x_mm, "
    "current_x_A: 3 of them, but the next line of numbers has 6 cells ('0,000,1,5,0,25'); if its commas are decimal marks, "
    "export the file with semicolons between the columns, or with decimal points",
    "time_s;x;y\n0;1\n1;2\n": "3 of them, but the next line of numbers has 2 cells ('0;1', about line 2); give each "
    "column a header",
}


@pytest.mark.parametrize("text", LOGS)
def test_delimited_text_that_is_no_table_says_line_and_remedy(text: str) -> None:
    with pytest.raises(FormatError) as caught:
        read_log_bytes(text.encode(), "f")
    assert LOGS[text] in str(caught.value)
    assert str(caught.value).startswith("f: line ")


GERMAN = "Prüfer;A. Mustermann\nWinkel;Abweichung;Bemerkung\n0,0;1,5;gut\n90,0;-2,5;\n"


def test_headers_of_another_language_are_named_with_the_table_that_maps_them() -> None:
    text = "Winkel [°];Abweichung\n0,0;1,5\n90,0;-2,5\n".replace(" [°]", "")
    with pytest.raises(FormatError) as caught:
        read_run_bytes(text.encode(), "f")
    assert str(caught.value) == (
        "f: line 1 has the column headers Winkel, Abweichung, and none of them says a quantity and its unit as angle_deg "
        "and radial_um do; rename them, or say what they are in test.toml, above its first table: "
        'columns = { angle_deg = "Winkel", radial_um = "Abweichung" }'
    )


def test_named_columns_are_read_and_the_others_do_not_matter(tmp_path: Path) -> None:
    path = tmp_path / "Messung.csv"
    path.write_text(GERMAN, encoding="utf-8")
    table = read_run(path, {"angle_deg": "Winkel", "radial_um": "Abweichung"})
    assert list(table.columns) == ["angle", "radial"]
    assert table.column("radial").tolist() == [0.0015, -0.0025]
    with pytest.raises(FormatError, match="has no column 'Winkl', which the test takes as angle_deg; did you mean 'Winkel'"):
        read_run(path, {"angle_deg": "Winkl"})
    with pytest.raises(FormatError, match="columns of the test: column 'angle' has no unit"):
        read_run(path, {"angle": "Winkel"})
    path.write_text(GERMAN.replace("gut", "1"), encoding="utf-8")
    with pytest.raises(FormatError, match=r"line 4, column Bemerkung: the cell is empty"):
        read_run(path, {"angle_deg": "Winkel", "force_N": "Bemerkung"})


def test_a_line_of_units_under_the_headers_of_a_run_is_understood() -> None:
    table = read_run_bytes(b"angle;radial\ndeg;um\n0;1.5\n90;-2.5\n", "f")
    assert table.column("radial").tolist() == [0.0015, -0.0025]
