"""What belongs to the machine, and what to one test, one instrument, one date.

Parameters of the machine are shared by all tests. A set-up that is asked for is that of a test (`E_Xt0@xy`), or of an
instrument where it goes with it from test to test (a bar's length, `E_R0@SERIAL`). What is asked by date is one parameter
for each date (`E_XX1@2026-03-01`). In a campaign of one, names stay plain.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase

from elastogeo.errors import InputError
from elastogeo.identification.symmetric_joints import reciprocal_sources
from elastogeo.observe import Campaign, MachineTest
from elastogeo.sources import Source, catalogue, select_sources

OF = "@"
"""What stands between the name of a parameter and what it is of."""


@dataclass(frozen=True, slots=True)
class Scopes:
    """The columns of a campaign.

    Attributes
    ----------
    sources : tuple of Source
        One per column, under the name of the column.
    absent : dict of str to frozenset of str
        For each test the names of the columns that are of others.
    """

    sources: tuple[Source, ...]
    absent: dict[str, frozenset[str]]


def scopes_of(campaign: Campaign) -> Scopes:
    """Which columns the tests of a campaign share, and which are of one test, instrument or date.

    Raises
    ------
    SelectionError
        If the question names no error source of the machine.
    InputError
        If a parameter is asked by date and a test has none.
    """
    machine = sources_of_machine(campaign)
    columns: dict[str, Source] = {}
    present: dict[str, set[str]] = {name: set() for name in campaign.tests}
    for name, test in campaign.tests.items():
        for source in machine:
            column = _by_date(source, name, test) if campaign.several else source
            columns.setdefault(column.name, column)
            present[name].add(column.name)
    for name, test in campaign.tests.items():
        for source in select_sources(test.machine, test.asked):
            if source.of_test:
                column = _of_test(source, name, test) if campaign.several else source
                columns.setdefault(column.name, column)
                present[name].add(column.name)
    every = _in_order(campaign, columns)
    return Scopes(every, {name: frozenset(columns) - present[name] for name in campaign.tests})


def sources_of_machine(campaign: Campaign) -> tuple[Source, ...]:
    """The error sources of the machine that a campaign asks for, each joint symmetric if that is asked."""
    sources = tuple(source for source in select_sources(campaign.machine, campaign.asked) if not source.of_test)
    return reciprocal_sources(sources) if campaign.question.reciprocal else sources


def truth_of(campaign: Campaign, sources: Sequence[Source]) -> Mapping[str, float]:
    """The true value of each column, of simulated tests of one and the same machine; empty of all others."""
    tests = campaign.tests
    if not campaign.several:
        return campaign.only.truth
    absent, found = scopes_of(campaign).absent, {}
    for source in sources:
        there = [test for name, test in tests.items() if source.name not in absent[name]]
        values = {test.truth.get(plain(source.name), 0.0) if test.truth else None for test in there}
        if len(values) != 1 or None in values:
            return {}
        found[source.name] = next(value for value in values if value is not None)
    return found


def plain(name: str) -> str:
    """The name of a parameter without what it is of."""
    return name.partition(OF)[0]


def preferred(names: Sequence[str], sources: Sequence[Source]) -> tuple[str, ...]:
    """The columns of names that are preferred: of a name without its test, those of all tests."""
    found = {name: [s.name for s in sources if name in (s.name, plain(s.name))] or [name] for name in names}
    return tuple(column for name in names for column in found[name])


def _in_order(campaign: Campaign, columns: dict[str, Source]) -> tuple[Source, ...]:
    """The columns in the order of the question of one test; of several in that of the catalogue, in any order of them."""
    if campaign.several:
        known = {name: k for k, name in enumerate(catalogue(campaign.machine))}
        return tuple(columns[name] for name in sorted(columns, key=lambda c: (OF in c, known.get(plain(c), len(known)), c)))
    asked = (source.name for source in select_sources(campaign.machine, campaign.asked))
    return tuple(columns[name] for name in asked if name in columns)


def _by_date(source: Source, name: str, test: MachineTest) -> Source:
    if not any(fnmatchcase(source.name, pattern) for pattern in test.question.by_date):
        return source
    date = test.about.date[:10]
    if not date:
        raise InputError(f"{source.name} is asked by date, and test {name!r} has none; say it under [about] of its file")
    return replace(source, name=f"{source.name}{OF}{date}", meaning=f"{source.meaning}, on {date}")


def _of_test(source: Source, name: str, test: MachineTest) -> Source:
    serial = test.about.instrument_serial.strip()
    if serial and source.name in test.setup.of_instrument:
        return replace(source, name=f"{source.name}{OF}{serial}", meaning=f"{source.meaning}, of instrument {serial}")
    return replace(source, name=f"{source.name}{OF}{name}", meaning=f"{source.meaning}, in test {name}")
