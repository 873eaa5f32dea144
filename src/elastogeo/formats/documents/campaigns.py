"""Campaign files: tests of one machine that are asked together, as a TOML document beside the folders of the tests."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.documents.machine_tests import FILE_NAME as TEST
from elastogeo.formats.documents.machine_tests import read_test
from elastogeo.formats.documents.machines import find_machine
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.observe import Campaign, KnownInfluence, MachineTest, Question, with_questions

SCHEMA = "elastogeo.campaign/1"
FILE_NAME = "campaign.toml"


@dataclass(frozen=True, slots=True)
class InstrumentDocument:
    """What is known of an instrument, for all tests that were made with it.

    Attributes
    ----------
    serial : str
        Serial number, as the tests say it: `instrument_serial` under `[about]`.
    influences : tuple of KnownInfluence
        Systematic influences that are the instrument's own: one quantity in all its tests.
    tests : tuple of str
        Tests that were made with it and do not say so themselves.
    """

    serial: str
    influences: tuple[KnownInfluence, ...] = ()
    tests: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class CampaignDocument:
    """What a campaign file says.

    Attributes
    ----------
    schema : str
    name : str
    tests : tuple of str
        Folders of the tests, or their files, beside this one; the name of its folder is that of the test.
    machine : str
        That all tests are of; if it is not said, that of the tests.
    question : Question or None
        What is asked of all tests together; if it is not said, what each test asks.
    instruments : tuple of InstrumentDocument
    """

    schema: str
    name: str
    tests: tuple[str, ...]
    machine: str = ""
    question: Question | None = None
    instruments: tuple[InstrumentDocument, ...] = field(default=())


def read_campaign(paths: str | Path | Sequence[str | Path], planned: int = 0) -> Campaign:
    """Read tests of one machine that are to be asked together.

    Parameters
    ----------
    paths : str, Path, or sequence of them
        Folders with a `test.toml` or a `campaign.toml`, or such files. One test is a campaign of one.
    planned : int
        Readings of a full turn to assume for every run instead of reading its file.

    Returns
    -------
    Campaign

    Raises
    ------
    FormatError
        If a file is not what it must be.
    InputError
        If the tests are not of one machine, or two have the same name.
    """
    given = [Path(paths)] if isinstance(paths, str | Path) else [Path(path) for path in paths]
    found = [_read(path, planned) for path in given]
    if len(found) == 1:
        return found[0]
    tests = _each_once((name, test) for campaign in found for name, test in campaign.tests.items())
    return Campaign(" + ".join(tests), tests)


@dataclass(frozen=True, slots=True)
class CampaignParts:
    """A campaign file with the places of its tests, of which none is opened.

    Attributes
    ----------
    file : Path
    text : str
        As it stands.
    name : str
    tests : mapping of str to Path
        By what the file calls them.
    serials : mapping of str to str
        Serial numbers of the instruments of tests that do not say them themselves, by the same.
    """

    file: Path
    text: str
    name: str
    tests: Mapping[str, Path]
    serials: Mapping[str, str]


def campaign_parts(path: str | Path) -> CampaignParts | None:
    """The campaign that a path means; None if it means none.

    Raises
    ------
    FormatError
        If the file is not what it must be.
    """
    file = campaign_file(Path(path))
    if file is None:
        return None
    document = _document(file)
    tests = {said: file.parent / said for said in document.tests}
    serials = {name: one.serial for one in document.instruments for name in one.tests}
    known = {said: serials[name_of(place)] for said, place in tests.items() if name_of(place) in serials}
    return CampaignParts(file, file.read_text("utf-8-sig"), document.name, tests, known)


def _read(path: Path, planned: int) -> Campaign:
    file = campaign_file(path)
    if file is None:
        test = read_test(path, planned=planned)
        return Campaign(test.name, {name_of(path): test})
    document = _document(file)
    tests = _each_once((name_of(file.parent / one), read_test(file.parent / one, planned=planned)) for one in document.tests)
    if document.machine:
        machine = find_machine(document.machine, file.parent)
        for name, test in tests.items():
            if test.machine != machine:
                raise InputError(
                    f"{file}: test {name!r} is of the machine {test.machine.name!r}, the campaign of {machine.name!r}"
                )
    campaign = Campaign(document.name, _with_instruments(tests, document.instruments, file))
    return campaign if document.question is None else with_questions(campaign, document.question)


def campaign_file(path: Path) -> Path | None:
    """The campaign file that a path means; None if it means a test."""
    if path.is_dir():
        return path / FILE_NAME if (path / FILE_NAME).is_file() and not (path / TEST).is_file() else None
    return path if path.is_file() and read_document(path).get("schema") == SCHEMA else None


def name_of(path: Path) -> str:
    """What a test is called in a campaign: as its folder; of a file with another name than `test.toml`, as the file."""
    place = path.resolve()
    return place.name if place.is_dir() else place.parent.name if place.name == TEST else place.stem


def _document(file: Path) -> CampaignDocument:
    table = read_document(file)
    check_schema(table, SCHEMA, str(file))
    document = build(CampaignDocument, table, str(file))
    if not document.tests:
        raise FormatError(f'{file}: names no test; name their folders: tests = ["xy", "yz"]')
    return document


def _each_once(tests: Iterable[tuple[str, MachineTest]]) -> dict[str, MachineTest]:
    found: dict[str, MachineTest] = {}
    for name, test in tests:
        if name in found:
            raise InputError(f"two tests are called {name!r}, after their folders; give one folder another name")
        found[name] = test
    return found


def _with_instruments(
    tests: dict[str, MachineTest], instruments: Sequence[InstrumentDocument], file: Path
) -> dict[str, MachineTest]:
    """The tests with what the campaign knows of their instruments."""
    for instrument in instruments:
        unknown = [name for name in instrument.tests if name not in tests]
        if unknown:
            raise InputError(
                f"{file}: instrument {instrument.serial} names test {unknown[0]!r}; there are {', '.join(tests)}"
            )
        made = [n for n, test in tests.items() if n in instrument.tests or test.about.instrument_serial == instrument.serial]
        if not made:
            raise InputError(
                f"{file}: no test says that it was made with instrument {instrument.serial!r}; write its number under "
                f"[about] of the tests, instrument_serial, or their names under [[instruments]], tests"
            )
        for name in made:
            tests = {**tests, name: _made_with(tests[name], instrument, f"{file}: test {name!r}")}
    return tests


def _made_with(test: MachineTest, instrument: InstrumentDocument, where: str) -> MachineTest:
    serial = test.about.instrument_serial
    if serial not in ("", instrument.serial):
        raise InputError(
            f"{where} says that it was made with instrument {serial!r}, the campaign says {instrument.serial!r}"
        )
    known = [one for one in instrument.influences if one not in test.influences]
    about = replace(test.about, instrument_serial=instrument.serial)
    return replace(test, influences=(*test.influences, *known), about=about)
