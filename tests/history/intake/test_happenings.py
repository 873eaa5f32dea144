"""Events of a history, listed: of all, of a machine with the instruments that tested it, of a kind, of a year."""

from collections.abc import Iterator

import pytest
from typer.testing import CliRunner

import elastogeo as eg
from elastogeo.cli.app import application
from elastogeo.errors import InputError
from elastogeo.report import view_of


@pytest.fixture
def history(tmp_path) -> Iterator[eg.History]:
    with eg.History(tmp_path / "h.db", create=True, who="A. Miller") as history:
        for name in ("Mill 3", "Mill 4"):
            history.add_machine(name)
        history.add_instrument("B-7", calibrated="2025-02-01", certificate="DK-12")
        history.add_event("repair", "nut of X", machine="Mill 3", at="2025-05-04")
        history.add_event("crash", "into the clamp", machine="Mill 4", at="2026-01-02")
        history.add_event("note", "balls cleaned", instrument="B-7", at="2026-03-01")
        yield history


def notes(history: eg.History, *asked: object) -> list[str]:
    return [one.event.note for one in history.events(*asked).events]  # type: ignore[arg-type]


def test_all_are_listed_the_newest_first_with_the_calibrations(history: eg.History) -> None:
    assert notes(history) == ["balls cleaned", "into the clamp", "nut of X", "DK-12"]
    assert history.events().years == (2026, 2025)
    assert [one.key for one in history.events().events] == [3, 2, 1, None]


def test_a_machine_a_kind_and_a_year_choose(history: eg.History) -> None:
    assert notes(history, "Mill 3") == ["nut of X"]
    assert notes(history, "", "crash") == ["into the clamp"]
    assert notes(history, "", "", 2025) == ["nut of X", "DK-12"]
    assert notes(history, "Mill 4", "", 2025) == []
    assert history.events("Mill 4", "", 2025).years == (2026,)
    assert view_of(history.events("Mill 4", "crash", 2025)).sentence == (
        "No crash is written down in 2025 of Mill 4 or the instruments that tested it."
    )
    with pytest.raises(InputError, match="'party' is no kind of event"):
        history.events("", "party")
    with pytest.raises(InputError, match="has no machine 'Mill 9'"):
        history.events("Mill 9")


def test_the_view_says_how_many_of_which_kind_and_the_last(history: eg.History) -> None:
    view = view_of(history.events())
    assert view.sentence == (
        "1 note, 1 crash, 1 repair and 1 calibration; the last on 1 March 2026: note of instrument B-7, balls cleaned."
    )
    assert view_of(history.events("Mill 3")).sentence == (
        "1 repair of Mill 3 or the instruments that tested it; the last on 4 May 2025: repair, nut of X."
    )
    assert view.tables[0].keys == ("", 2, 1, "")
    assert view.document["schema"] == "elastogeo.events/1"


def test_the_command_lists_without_a_note_and_keeps_with_one(history: eg.History) -> None:
    command, at = application("history", "event"), ["--store", history.store.url]
    listed = CliRunner().invoke(command, ["history", "event", "crash", *at])
    assert (listed.exit_code, "into the clamp" in listed.output, "nut of X" in listed.output) == (0, True, False)
    kept = CliRunner().invoke(command, ["history", "event", "move", "to hall 2", "-m", "Mill 3", *at])
    assert kept.exit_code == 0
    assert notes(history, "Mill 3")[0] == "to hall 2"
