"""`elastogeo plan`: which tests to run on a machine, and what they will tell."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Reciprocal, Report


def plan(
    made: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[TEST]...", help="Folders with tests that were made already; the plan adds to them."),
    ] = None,
    machine: Annotated[str, typer.Option(help="A shipped machine, or a machine file; else that of the tests made.")] = "",
    tests: Annotated[int, typer.Option(help="How many tests; else as many as support the whole volume.", min=0)] = 0,
    minutes: Annotated[float, typer.Option(help="Time that there is.", min=0)] = 0.0,
    goal: Annotated[str, typer.Option(help="workspace, parameters or information.")] = "workspace",
    parameter: Annotated[
        list[str] | None, typer.Option("--parameter", "-p", help="Compliance to know by itself; may be repeated.")
    ] = None,
    instrument: Annotated[list[str] | None, typer.Option(help="Instrument that there is; may be repeated.")] = None,
    tool_length: Annotated[
        list[float] | None,
        typer.Option(help="Tool that will be used [mm], from the last carriage to its tip; may be repeated."),
    ] = None,
    force: Annotated[list[float] | None, typer.Option(help="Force level of every test [N]; two at least.")] = None,
    candidates: Annotated[int, typer.Option(help="Tests to draw and choose from.", min=1)] = 400,
    reciprocal: Reciprocal = False,
    write: Annotated[
        Path | None,
        typer.Option(help="Folder to make: a campaign of the planned tests, for their runs, with a program each."),
    ] = None,
    flavour: Annotated[str, typer.Option(help="Of the programs: iso, linuxcnc, sinumerik, heidenhain.")] = "iso",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Say which tests to run, and what they will tell.

    \b
    Examples:
      elastogeo plan --machine hermle_c50 --tests 8
      elastogeo plan --machine hermle_c50 -p C_XXX --tests 4
      elastogeo plan my-campaign --minutes 120
      elastogeo plan --machine hermle_c50 --tests 8 --write my-campaign --flavour sinumerik
    """
    from elastogeo.cli import screen

    with screen.progress("reading", quiet=as_json) as step:
        done = eg.read_campaign(made) if made else None
        if done is None and not machine:
            raise eg.InputError(
                "there is no machine to plan for; say --machine hermle_c50, a machine file, or a test made on it"
            )
        found = eg.plan(
            eg.read_machine(machine) if machine or done is None else done.machine,
            tests=tests or None,
            minutes=minutes or None,
            goal=goal,
            parameters=parameter or (),
            made=done,
            instruments=instrument or ("loaded-ball-bar",),
            tool_lengths=tool_length or (),
            forces=force or (),
            count=candidates,
            reciprocal=reciprocal,
            progress=step,
        )
        if write is not None:
            step("writing tests and programs")
            without = _write(found, write, machine, flavour)
    screen.show(found, report, as_json)
    if write is not None and not as_json:
        screen.say(f"Written: {write}, a campaign to measure, with programs.")
        for name, why in without.items():
            screen.say(f"{name} has no program: {why}")


def _write(found: Any, folder: Path, machine: str, flavour: str) -> dict[str, str]:
    """The planned tests as folders, and the programs that make their paths; why a test has none, by name.

    Raises
    ------
    InputError
        If it is not said which machine file the tests are to name.
    """
    if not machine:
        raise eg.InputError("the planned tests name their machine by its file; say --machine beside --write")
    eg.write_tests(found.campaign, folder, machine)
    programs = folder / "programs"
    programs.mkdir()
    without = {}
    for name, test in found.campaign.tests.items():
        try:
            eg.write_program({name: test}, programs, flavour)
        except eg.ElastogeoError as error:
            without[name] = str(error)
    return without
