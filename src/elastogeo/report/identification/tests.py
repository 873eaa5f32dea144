"""The tests of a campaign: what each is, what it tells alone, what it adds, and what only all of them together tell."""

from __future__ import annotations

from elastogeo.identification import Explanation, Identification, TestPart
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import UM
from elastogeo.report.view import Table

_MICRO = 1e6
_MOST_NAMES = 8


def test_table(result: Identification) -> Table:
    """One row for each test."""
    rows = tuple(_row(result, part) for part in result.tests)
    return Table(
        ("test", "instrument", "runs", "force [N]", "RMSE", "left out", "scatter", "rank", "rank so far", "adds"),
        rows,
        words=(0, 1, 9),
        title="Tests",
        note="RMSE: of its readings against the estimate from all tests; left out: against the "
        "prediction from all other tests, what these do not determine fitted to it; scatter: about its own best fit, which "
        "decides what its readings count. Rank: how many combinations the test determines alone, and with those above it; "
        "adds: parameters that it determines with those above it, and they do not.",
    )


def step_table(explained: Explanation) -> Table:
    """What each test adds to those before it, planned or run."""
    return Table(
        ("test", "rank", "rank so far", "adds"),
        tuple((s.name, str(s.rank), str(s.rank_so_far), pretty(", ".join(s.adds))) for s in explained.steps),
        words=(0, 3),
        title="Tests",
        note="Rank: how many combinations the test determines alone, and with those above it; adds: parameters, each for "
        "what it stands for below, that are determined from this test on.",
    )


def information_table(result: Identification) -> Table:
    """How much information each test gives to each parameter."""
    names = [part.name for part in result.tests]
    rows = tuple(
        (name, *("only" if share == 1 else f"{100 * share:.0f}" for share in (shares[test] for test in names)))
        for name, shares in result.information.items()
    )
    return Table(
        ("parameter", *names),
        rows,
        title="Information [%]",
        note="By how much the variance of a parameter with all tests is less than without the test; only: without the test "
        "nothing is known of it.",
    )


def together_words(result: Identification) -> tuple[str, ...]:
    """What the tests together tell that none tells alone; nothing of one test."""
    if not result.campaign.several:
        return ()
    count, every = len(result.together), len(result.parameters)
    if not count:
        return (f"Each of the {every} parameters is determined by one of the tests alone.",)
    return (
        f"Together the tests determine {count} of {every} parameters that none of them determines alone: "
        f"{named(result.together)}.",
    )


def named(names: tuple[str, ...], most: int = _MOST_NAMES) -> str:
    """Names, of which the first are written."""
    more = f" and {len(names) - most} more" if len(names) > most + 1 else ""
    return ", ".join(names[:most] if more else names) + more


def _row(result: Identification, part: TestPart) -> tuple[str, ...]:
    test = result.campaign.tests[part.name]
    found = result.tests_agreement
    unit, factor = ("µrad", _MICRO) if part.angular else ("µm", UM)
    return (
        part.name,
        test.instrument.replace("-", " "),
        str(part.runs),
        _forces(part.forces),
        f"{significant(part.rmse * factor)} {unit}",
        "" if found is None else f"{significant(found.against[part.name].rmse * factor)} {unit}",
        "" if part.scatter is None else f"{significant(part.scatter * factor)} {unit}",
        str(part.rank),
        str(part.rank_so_far),
        pretty(named(part.adds)),
    )


def _forces(forces: tuple[float, ...]) -> str:
    if len(forces) <= 3:
        return ", ".join(f"{force:g}" for force in forces)
    return f"{forces[0]:g} to {forces[-1]:g}"
