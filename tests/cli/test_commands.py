"""The doors: exit codes, standard output and error, the JSON contract, what a newcomer types."""

import importlib
import json
import os
import subprocess
import sys

import pytest

from elastogeo.cli import main
from elastogeo.cli.doors import ORDER, Group, doors, every
from elastogeo.formats import example_test

FILES = {
    one.module: typed
    for name, door in doors().items()
    for typed, one in (
        {f"{name} {inner}": command for inner, command in door.commands.items()} if isinstance(door, Group) else {name: door}
    ).items()
}
"""What is typed for the command of each file."""


@pytest.fixture
def my_test(tmp_path, elastogeo):
    assert elastogeo("new", tmp_path / "t", "--force", "36", "--force", "742")[0] == 0
    assert elastogeo("simulate", tmp_path / "t", tmp_path / "t" / "simulation.toml")[0] == 0
    return tmp_path / "t"


def refused(result, code, *parts):
    assert result[0] == code, result
    assert result[1] == ""
    assert result[2].startswith("elastogeo: ")
    assert "Traceback" not in result[2]
    for part in parts:
        assert part in result[2]


def test_the_life_of_a_test_from_new_to_report(my_test, elastogeo, tmp_path):
    code, out, err = elastogeo("identify", my_test, "--report", tmp_path / "r")
    assert (code, err) == (0, "")
    assert "C_XXX stands for C_XXX + C_XXY" in out
    assert (tmp_path / "r" / "report.html").stat().st_size > 10_000


def test_identify_prints_the_contract_as_json_and_nothing_else(my_test, elastogeo):
    code, out, err = elastogeo("identify", my_test, "--json")
    assert (code, err) == (0, "")
    document = json.loads(out)
    contract = (
        "schema software test parameters null confounded rank columns condition_raw condition_scaled rmse_um levels verdict"
    )
    assert set(contract.split()) <= set(document)
    assert {"name", "value", "unit", "standard_uncertainty", "interval95", "stands_for", "peak_to_peak_um", "share"} <= set(
        document["parameters"][0]
    )
    assert {"force_N", "readings", "rmse_um", "fitness_percent"} <= set(document["levels"][0])
    assert document["rank"] == 11
    assert document["columns"] == 23
    value = {p["name"]: p["value"] for p in document["parameters"]}
    assert value["C_XXX"] == pytest.approx(6e-5, rel=0.01)


def test_a_preferred_parameter_is_retained(my_test, elastogeo):
    _, out, _ = elastogeo("identify", my_test, "--json", "--prefer", "C_XXY", "-p", "planar-xy")
    parameters = {p["name"]: p["stands_for"] for p in json.loads(out)["parameters"]}
    assert "C_XXX" not in parameters
    assert parameters["C_XXY"] == pytest.approx({"C_XXY": 1.0, "C_XXX": 1.0})


def test_confounding_before_any_run_is_made(tmp_path, elastogeo):
    elastogeo("new", tmp_path / "t")
    code, out, err = elastogeo("explain", tmp_path / "t", "--planned", "90", "-p", "C_*", "--json")
    assert (code, err) == (0, "")
    document = json.loads(out)
    assert (document["columns"], document["rank"]) == (180, 6)
    code, out, _ = elastogeo("explain", tmp_path / "t", "--planned", "90")
    assert code == 0
    assert "Always together: C_XXX, C_XXY" in out
    assert "no reading of this test: nothing at all is known of them" in out


def test_machines(elastogeo):
    code, out, _ = elastogeo("machines")
    assert code == 0
    assert "wCAFYXZSt" in out
    assert "[w C' A' b Y X Z (C1) t]" in out
    code, out, _ = elastogeo("machines", "hermle_c50")
    assert code == 0
    assert "Assumed: All link offsets" in out
    assert [m["topology"] for m in json.loads(elastogeo("machines", "--json")[1])["machines"]] == ["wCAFYXZSt", "wCAYFXZt"]


def test_the_demo_writes_its_report_and_says_what_its_readings_are(tmp_path, elastogeo):
    code, out, _ = elastogeo("demo", "--report", tmp_path / "r")
    assert code == 0
    assert "neither measured by us nor simulated" in out
    assert str(tmp_path / "r" / "report.html") in out.replace("\n", "")
    names = {path.name for path in (tmp_path / "r").rglob("*.svg")}
    assert len(names) >= 5


def test_wrong_input_ends_with_2_and_one_clear_error(my_test, elastogeo, tmp_path):
    refused(elastogeo("identify", tmp_path / "nowhere"), 2, "cannot be opened")
    refused(elastogeo("identify", my_test, "-p", "C_QQQ"), 2, "'C_QQQ' selects no error source", "wCAFYXZSt")
    refused(elastogeo("identify", my_test, "--prefer", "C_XXZ"), 2, "preferred parameters C_XXZ are not among")
    refused(elastogeo("new", my_test), 2, "is there already")
    refused(elastogeo("new", tmp_path / "n", "--machine", "x"), 2, "there is no machine 'x'")
    refused(elastogeo("machines", "x"), 2, "there is no machine 'x'")
    refused(elastogeo("simulate", my_test, my_test / "simulation.toml"), 2, "never overwritten")
    run = my_test / "runs" / "36N-1.csv"
    run.write_text(run.read_text().replace("radial_um", "radial"))
    refused(elastogeo("identify", my_test), 2, "36N-1.csv", "radial", "radial_um")


def test_what_the_data_do_not_support_ends_with_1(my_test, elastogeo):
    asked = elastogeo("identify", my_test, "-p", "planar-xy", "--reference", "50")
    refused(asked, 1, "the reference level 50 N cannot be subtracted", "36, 742 N")
    asked = elastogeo("identify", my_test, "-p", "E_XX1", "--reference", "36")
    refused(asked, 1, "E_XX1", "changes any reading")


def test_wrong_usage_ends_with_2(elastogeo):
    assert elastogeo("identify")[0] == 2
    assert elastogeo("no-such-command")[0] == 2
    assert elastogeo("new", "x", "--repeats", "-1")[0] == 2


def test_version_and_help_with_an_example_for_every_command(elastogeo):
    assert elastogeo("--version") == (0, "elastogeo 0.2.0\n", "")
    for command in ("demo", "new", "simulate", "identify", "explain", "machines"):
        code, out, _ = elastogeo(command, "--help")
        assert code == 0
        assert f"  elastogeo {command}" in out, command


def test_no_colour_is_printed_where_none_is_wanted(my_test):
    environment = {**os.environ, "NO_COLOR": "1", "FORCE_COLOR": "1", "TERM": "xterm-256color"}
    command = [sys.executable, "-m", "elastogeo", "identify", str(my_test)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    assert "\x1b[3" not in done.stdout


def test_a_file_name_with_markup_is_printed_as_it_is(my_test, elastogeo):
    file = my_test / "test.toml"
    file.write_text(file.read_text().replace("Loaded ball bar test", "[bold red]x[/] <script>"))
    assert "[bold red]x[/] <script>" in elastogeo("identify", my_test)[1]


def test_the_example_is_found():
    assert (example_test() / "test.toml").is_file()


@pytest.mark.parametrize("group", ["", *(name for name, door in doors().items() if isinstance(door, Group))])
def test_the_help_lists_every_command_with_its_whole_summary(group):
    """One word each, in the order of the design; at 80 columns no summary is cut."""
    environment = {**os.environ, "COLUMNS": "80", "TERMINAL_WIDTH": "80", "NO_COLOR": "1"}
    words = [sys.executable, "-m", "elastogeo", *group.split(), "--help"]
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=environment)
    listed = done.stdout.partition("Commands:\n")[2].splitlines()
    names = [line.split()[0] for line in listed]
    inside = doors()[group].commands if group else doors()
    order = importlib.import_module(f"elastogeo.cli.{group}").ORDER if group else ORDER
    assert names == list(inside)
    assert names == sorted(names, key=order.index)
    assert all(line.endswith(".") and not line.endswith("..") for line in listed)


@pytest.mark.parametrize("typed", ["identify", "history list"])
def test_only_the_command_that_is_asked_is_imported(typed):
    probe = "import sys; from elastogeo.cli.app import application; application(*sys.argv[1:]); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", probe, *typed.split()], capture_output=True, text=True, check=True)
    assert [FILES[one] for one in done.stdout.split() if one in FILES] == [typed]


def test_a_command_that_python_keeps_the_name_of_is_typed_without_its_underscore(elastogeo):
    assert "history list" in every()
    assert elastogeo("history", "list", "--help")[0] == 0
    code, out, err = elastogeo("history", "list_", "--help")
    assert (code, out) == (2, "")
    assert "No such command 'list_'" in err


def test_a_group_without_a_command_shows_its_commands(elastogeo):
    code, out, err = elastogeo("history")
    assert code == 2
    assert "Usage: elastogeo history [OPTIONS] COMMAND" in out + err
    assert "\n  list " in out + err


def test_linear_algebra_has_one_thread_unless_the_user_says_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.environ", {**os.environ, "OMP_NUM_THREADS": "3"})
    os.environ.pop("OPENBLAS_NUM_THREADS", None)
    monkeypatch.setattr("sys.argv", ["elastogeo", "--version"])
    assert main() == 0
    assert (os.environ["OPENBLAS_NUM_THREADS"], os.environ["OMP_NUM_THREADS"]) == ("1", "3")
