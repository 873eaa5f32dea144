"""What is said of backups, checks, calibrations and limits, from results made by hand."""

from __future__ import annotations

import pytest

from elastogeo.changes import KINDS, KeptCheck, KeptCopies, KeptCopy, WantedOfIndicator
from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.report.changes import taken
from elastogeo.report.registers.copies_view import size_said
from elastogeo.report.registers.wanted_view import entered_values

NOW = 20_000.0


def copies(age: float | None, faults: int | None = None) -> KeptCopies:
    made = () if age is None else (KeptCopy(NOW - age, "A. Miller", "/backups/one", 100, 12, 3_400_000, ()),)
    looked = (
        () if faults is None else (KeptCheck(NOW - 2, "A. Miller", 100, 12, faults, ("raw file ab is missing",) * faults),)
    )
    return KeptCopies("shop.db", NOW, "/backups", made, looked)


@pytest.mark.parametrize(
    ("age", "faults", "tone", "said"),
    [
        (None, None, "bad", "No backup"),
        (0.2, None, "good", "Backed up"),
        (6.9, 0, "good", "Backed up"),
        (7.5, 0, "care", "The last backup is old"),
        (32.0, 0, "bad", "The last backup is too old"),
        (0.2, 1, "bad", "Not as it was written"),
    ],
)
def test_the_state_of_backups_is_that_of_the_last_one_and_the_last_check(
    age: float | None, faults: int | None, tone: str, said: str
) -> None:
    badge = view_of(copies(age, faults)).badge
    assert badge is not None
    assert (badge.tone, badge.text) == (tone, said)


def test_what_was_found_is_said_by_name_and_the_rest_is_counted() -> None:
    whole = view_of(copies(3.0, 0))
    assert whole.sentence == "The last backup is 3 days old. All was checked 2 days ago: as it was written."
    assert "1 fault: raw file ab is missing." in view_of(copies(3.0, 1)).sentence


@pytest.mark.parametrize(("size", "said"), [(0, "0 bytes"), (999, "999 bytes"), (3_400_000, "3.40 MB"), (2.5e12, "2.50 TB")])
def test_a_size_is_said_in_the_unit_that_fits(size: int, said: str) -> None:
    assert size_said(int(size)) == said


@pytest.mark.parametrize("kind", KINDS.values(), ids=lambda kind: kind.name)
def test_what_a_form_shows_of_a_limit_is_kept_as_it_was_when_it_is_sent_back(kind) -> None:  # type: ignore[no-untyped-def]
    """Units once out and once in: nothing is changed by opening a form and sending it."""
    wanted = WantedOfIndicator("x", kind, lower=-1.25, upper=13.5, relevance=0.0625)
    lower, upper, matters, _, _ = entered_values(wanted)
    back = taken(kind, float(lower), float(upper), float(matters))
    assert back == pytest.approx((-1.25, 13.5, 0.0625), rel=1e-9)


def test_a_share_is_entered_in_percent_and_a_length_in_micrometres() -> None:
    with pytest.raises(InputError, match="stiffness must stay between 20 and 10 N/µm: no value does; exchange them"):
        taken(KINDS["stiffness"], 20.0, 10.0)
    with pytest.raises(InputError, match="the least change of stiffness that matters is -3 %; give zero or more"):
        taken(KINDS["stiffness"], matters=-3.0)
    assert taken(KINDS["stiffness"], 13.0, None, 5.0) == (pytest.approx(13_000.0), None, pytest.approx(0.05))
    assert taken(KINDS["backlash"], None, 4.0, 1.0) == (None, pytest.approx(0.004), pytest.approx(0.001))
    assert entered_values(WantedOfIndicator("squareness XY", KINDS["squareness"]))[2:] == ("3", "\u00b5rad", "\u00b5rad")
