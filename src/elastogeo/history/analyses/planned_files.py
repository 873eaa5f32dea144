"""Planned tests as the files of the folder to measure, and the programs that are made of these files for a control."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from io import BytesIO
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from elastogeo.changes import ProgramFacts
from elastogeo.errors import ElastogeoError, InputError
from elastogeo.formats import flavours, program_text, programs_of, read_campaign, write_tests
from elastogeo.history.analyses.bases import Definition
from elastogeo.observe import Campaign

FOLDER, MACHINE = "campaign", "machine.toml"
READINGS = 360
"""Of a turn, as `elastogeo nc` assumes them of a test without runs."""


def planned_files(campaign: Campaign, definition: Definition) -> dict[str, str]:
    """The folder to measure: texts by their paths."""
    with TemporaryDirectory(prefix="elastogeo-", ignore_cleanup_errors=True) as made:
        top = Path(made).resolve()
        named = definition.name
        if not named:
            (top / MACHINE).write_text(definition.text, encoding="utf-8")
            named = str(top / MACHINE)
        write_tests(campaign, top / FOLDER, named)
        return {
            file.relative_to(top).as_posix(): file.read_text(encoding="utf-8")
            for file in sorted(top.rglob("*"))
            if file.is_file()
        }


def program_facts(files: Mapping[str, str], tests: Mapping[str, object]) -> tuple[ProgramFacts, ...]:
    """The programs of planned tests, in their order; why one has none."""
    found = []
    with _laid_out(files) as folder:
        for name in tests:
            try:
                programs, _ = programs_of(read_campaign(folder / name, planned=READINGS))
            except ElastogeoError as error:
                found.append(ProgramFacts(name, error=str(error).replace(f"{folder}/", "")))
                continue
            for program in programs.values():
                moves = program.moves()
                minutes = float(moves.duration.sum() + moves.pause.sum()) / 60
                found.append(ProgramFacts(name, len(program.blocks), minutes))
    return tuple(found)


def program_of(files: Mapping[str, str], test: str, flavour: str) -> tuple[str, bytes]:
    """The program of a planned test for a control: the name of its file, and what `elastogeo nc` writes to it.

    Raises
    ------
    InputError
        If there is no such test or flavour.
    PathError
        If the machine cannot make it.
    """
    known = flavours()
    if flavour not in known:
        raise InputError(f"there is no flavour {flavour[:40]!r} of programs; there are: {', '.join(known)}")
    if f"{FOLDER}/{test}/test.toml" not in files:
        raise InputError("the plan has no such test")
    with _laid_out(files) as folder:
        programs, writing = programs_of(read_campaign(folder / test, planned=READINGS))
    ((name, program),) = programs.items()
    return f"{name}{known[flavour].suffix}", program_text(program, flavour, writing).encode("ascii")


def folder_of(files: Mapping[str, str]) -> bytes:
    """The folder to measure as a zip, with the programs of its tests for every control; the same bytes for the same plan.

    Raises
    ------
    InputError
        If there are no files.
    """
    if not files:
        raise InputError("this plan was kept without the files of its tests; elastogeo plan --write makes them")
    texts = {name: text.encode("utf-8") for name, text in files.items()}
    tests = [PurePosixPath(name).parent.name for name in files if name.endswith("/test.toml")]
    for flavour in flavours():
        for test in tests:
            with suppress(ElastogeoError):  # one that has no program is named where the programs are listed
                name, content = program_of(files, test, flavour)
                texts[f"{FOLDER}/programs/{flavour}/{name}"] = content
    whole = BytesIO()
    with ZipFile(whole, "w", ZIP_DEFLATED) as packed:
        for name, content in sorted(texts.items()):
            packed.writestr(ZipInfo(name), content, ZIP_DEFLATED)
    return whole.getvalue()


@contextmanager
def _laid_out(files: Mapping[str, str]) -> Iterator[Path]:
    """The folder of the campaign, written again."""
    with TemporaryDirectory(prefix="elastogeo-", ignore_cleanup_errors=True) as made:
        top = Path(made).resolve()
        for name, text in files.items():
            path = PurePosixPath(name)
            if path.is_absolute() or ".." in path.parts:
                raise InputError(f"the plan names the file {name[:60]!r}, which would lie outside of its folder; plan anew")
            target = top / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        yield top / FOLDER
