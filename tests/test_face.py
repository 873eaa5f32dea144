"""The public face: what `import elastogeo as eg` gives, that it is light, and how results show and compare themselves."""

import ast
import json
import pkgutil
import subprocess
import sys
import typing
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

import elastogeo as eg
from elastogeo.errors import InputError, SelectionError
from elastogeo.identification import Identification

ROOT = Path(__file__).parent.parent
EXAMPLE = ROOT / "examples" / "hermle-c50-ldbb"
PLANNED_ROOMS = {"web", "fleet", "validation", "history", "changes", "planning", "prediction"}


@pytest.fixture(scope="module")
def result() -> Identification:
    return eg.identify(eg.read_test(str(EXAMPLE)))


def test_every_name_of_the_face_is_there_typed_and_listed() -> None:
    tree = ast.parse(Path(eg.__file__).read_text(encoding="utf-8"))
    typed = next(node for node in tree.body if isinstance(node, ast.If))
    names = {alias.name for node in typed.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert names == set(eg._HOME) == set(eg.__all__) - {"__version__"}
    assert dir(eg) == sorted(eg.__all__)
    assert {name: getattr(eg, name).__module__.split(".")[1] for name in names} == eg._HOME
    assert 20 <= len(names) <= 45


def test_no_name_of_the_face_is_a_room() -> None:
    """Python would replace the function by the module when the room is imported."""
    rooms = {module.name for module in pkgutil.iter_modules(eg.__path__)} | PLANNED_ROOMS
    assert {"identification", "report", "estimate"} <= rooms
    assert rooms & set(eg.__all__) == set()


def test_a_name_that_is_not_of_the_face_says_which_are() -> None:
    with pytest.raises(AttributeError, match=r"elastogeo has no 'idntify'; it has Campaign, .*identify"):
        eg.idntify  # noqa: B018


def test_importing_elastogeo_imports_nothing_heavy() -> None:
    probe = "import sys, elastogeo; print(*sorted({name.partition('.')[0] for name in sys.modules}))"
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    assert {"numpy", "scipy", "pydantic", "rich", "typer"} & set(done.stdout.split()) == set()


def test_two_lines_answer_on_one_screen() -> None:
    """Done-when 7 of issue 8; twice on purpose: the second call must find functions where the first has imported rooms."""
    line = f"r = eg.identify(eg.read_test({str(EXAMPLE)!r})); "
    code = f"import elastogeo as eg; {line}{line}print(r); print(r['C_XXX'])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    assert len(lines) < 40
    assert lines[-1].startswith("C_XXX = 61.9")
    assert lines[-1].endswith("nm/N (95 %)")
    assert "residuals without structure" in done.stdout


def test_a_parameter_is_an_estimate_with_its_unit(result: Identification) -> None:
    found = result["C_XXX"]
    assert (found.name, found.unit) == ("C_XXX", "mm/N")
    assert found.estimate == eg.Estimate(found.value, found.standard_uncertainty, found.degrees_of_freedom)
    assert repr(found) == str(found)
    assert "C_XXX" in result
    assert "C_XXY" not in result
    assert list(result) == [parameter.name for parameter in result.parameters]


def test_what_a_result_does_not_have_is_explained(result: Identification) -> None:
    with pytest.raises(SelectionError, match="'E_ZZ1' was not asked for; this result has C_XXX, "):
        result["E_ZZ1"]
    planar = eg.explain(result.test, parameters="planar-xy", reference="none")
    asked = replace(
        result, confounding=planar.confounding, parameters=(replace(result["C_XXX"], stands_for={"C_XXY": 1.0}),)
    )
    with pytest.raises(SelectionError, match="does not determine C_XXY by itself; it is part of the sum under C_XXX"):
        asked["C_XXY"]
    with pytest.raises(SelectionError, match="C_XCX changes no reading of this test"):
        asked["C_XCX"]


def test_results_show_themselves_in_few_lines(result: Identification) -> None:
    shown = [result, eg.diagnose(result), eg.what_if(result, "E_XX1"), eg.explain(result.test)]
    for one in shown:
        assert len(repr(one).splitlines()) <= 4
        assert len(repr(one)) < 500
        assert len(str(one).splitlines()) < 40
        assert "nan" not in str(one).lower().split()
        html = one._repr_html_()
        assert html.count("<tr>") == html.count("</tr>") > 2
    assert len(repr(result.test)) < 200
    assert len(repr(result.test.runs[0])) < 200


def test_results_and_tests_are_equal_by_value(result: Identification) -> None:
    again = eg.identify(eg.read_test(EXAMPLE))
    assert again is not result
    assert again == result
    assert again.test == result.test
    assert again.solution == result.solution
    first = result.test.runs[0]
    moved = replace(first, columns={**first.columns, "radial": first.columns["radial"] + 1e-9})
    assert moved != first
    assert replace(result.test, runs=(moved, *result.test.runs[1:])) != result.test
    assert replace(result, rmse=result.rmse * (1 + 1e-12)) != result
    assert result != result.test
    assert result != None  # noqa: E711


def test_a_table_is_rows_or_a_data_frame(result: Identification) -> None:
    rows = result.table()
    assert [row["name"] for row in rows] == list(result)
    assert rows[0]["value"] == result["C_XXX"].value
    frame = result.table("pandas")
    assert isinstance(frame, pd.DataFrame)
    assert frame.loc[0, "value"] == result["C_XXX"].value
    with pytest.raises(InputError, match="comes as rows, pandas or polars, not as 'arrow'"):
        result.table(typing.cast(typing.Any, "arrow"))


def test_a_data_frame_without_its_package_says_so(result: Identification, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "polars", None)
    with pytest.raises(InputError, match="polars is not installed; install it, or take the table as rows"):
        result.table("polars")


def test_every_result_is_one_json_object(result: Identification) -> None:
    for one in (result, eg.diagnose(result), eg.what_if(result, "E_XX1"), eg.explain(result.test)):
        assert json.loads(one.to_json()) == one.to_dict()
        assert one.to_dict()["schema"].startswith("elastogeo.")


def test_one_name_may_be_asked_for_as_it_is(result: Identification) -> None:
    asked = eg.explain(result.test, parameters="planar-xy", prefer="C_XXY", reference=36).test.question
    assert asked.parameters == ("planar-xy",)
    assert asked.prefer == ("C_XXY",)
    assert asked.reference_force == 36.0
    with pytest.raises(InputError, match="the reference level is 'least'; give a force in N, or 'none'"):
        eg.explain(result.test, reference=typing.cast(typing.Any, "least"))


def test_a_test_is_made_and_simulated_and_identified(tmp_path: Path) -> None:
    eg.new_test(str(tmp_path / "t"), forces=[100.0, 400.0, 700.0])
    simulated = eg.simulate(tmp_path / "t", write=True)
    assert simulated.simulated
    read = eg.read_test(str(tmp_path / "t"))
    assert [run.name for run in read.runs] == [run.name for run in simulated.runs]
    assert eg.explain(eg.read_test(tmp_path / "t", planned=90)).confounding.rank > 0


def test_machines_come_by_name_or_file() -> None:
    assert eg.machines()["hermle_c50"] == eg.read_machine("hermle_c50")
    with pytest.raises(InputError, match="nowhere"):
        eg.read_machine("nowhere.toml")


def test_a_test_is_compared_as_it_is_and_a_result_is_not_asked_again(result: Identification) -> None:
    found = eg.compare(result, result.test)
    assert found.before == found.after == result
    assert all(difference.change.value == 0 for difference in found.differences)
    with pytest.raises(InputError, match="parameters cannot be asked of a result; ask the test"):
        eg.diagnose(result, parameters="ball-bar-xy")


def test_a_check_prints_as_a_sentence_with_its_mark(result: Identification) -> None:
    shown = {check.name: str(check) for check in result.verdict}
    assert shown["identifiable"] == "  ok  identifiable: All 13 parameters are determined by the test."
    assert shown["above resolution"].startswith("look  above resolution: C_CCY")
