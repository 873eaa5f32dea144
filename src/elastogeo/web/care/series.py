"""A series: the tests of its baseline, the limits of its indicators, how often it is tested."""

from __future__ import annotations

from functools import partial
from typing import Annotated

from fastapi import Form

from elastogeo.changes import SeriesRecord
from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.report.changes import taken
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask, Asked, or_not_found
from elastogeo.web.fields import Why
from elastogeo.web.pages import Pages

pages = Pages()

Number = Annotated[str, Form(max_length=40)]


def _series(asked: Asked, key: int) -> SeriesRecord:
    with or_not_found("There is no such series."):
        return asked.history.series_settings(key)


@pages.shows("/settings/series/{key:int}")
def series(asked: Ask, key: int) -> Shown:
    """What is wanted of one series, and what that is decided from."""
    found = _series(asked, key)
    context = {
        "key": key,
        "wanted": found.wanted,
        "indicators": {one.name: one for one in found.indicators},
        "in_baseline": [test.key for test in found.tests if test.in_baseline],
        "aside": [test.key for test in found.tests if test.aside],
    }
    return Shown("care/series.html.j2", view_of(found), context=context)


@pages.acts("/settings/series/{key:int}/baseline", role=ENGINEER)
def set_baseline(
    asked: Ask,
    key: int,
    why: Why,
    which: Annotated[str, Form(max_length=10)] = "chosen",
    count: Number = "",
    tests: Annotated[list[int] | None, Form(max_length=1000)] = None,
) -> Done:
    """Set the tests that count as the ordinary state: `chosen` ones, or the `first` or `last` so many."""
    of = _series(asked, key).wanted
    set_ = partial(asked.history.set_baseline, of.machine, of.series, why=why)
    if which == "first":
        chosen = set_(first=_whole(count, "how many tests"))
    elif which == "last":
        chosen = set_(last=_whole(count, "how many tests"))
    elif tests:
        chosen = set_(tests=tests)
    else:
        raise InputError("no test was chosen; a baseline is made of two tests or more, of six or more for alarms")
    said = f"The baseline is made of {len(chosen.tests)} tests." if chosen.new else "It was set so already."
    return Done(f"/settings/series/{key}", said)


@pages.acts("/settings/series/{key:int}/limits", role=ENGINEER)
def set_limits(
    asked: Ask,
    key: int,
    indicator: Annotated[str, Form(max_length=80)],
    why: Why,
    lower: Number = "",
    upper: Number = "",
    matters: Number = "",
) -> Done:
    """Set between which values an indicator must stay, and from when on a change matters, in the unit shown; empty: none."""
    of = _series(asked, key).wanted
    kind = asked.history.kind(of.machine, indicator, of.series)
    values = [
        _number(text, what) for text, what in ((lower, "the least"), (upper, "the greatest"), (matters, "what matters"))
    ]
    least, most, relevance = taken(kind, *values)
    asked.history.set_tolerance(of.machine, indicator, of.series, why=why, lower=least, upper=most, relevance=relevance)
    return Done(f"/settings/series/{key}", f"The limits of {indicator} are kept; the series was judged again by them.")


@pages.acts("/settings/series/{key:int}/interval", role=ENGINEER)
def set_interval(asked: Ask, key: int, why: Why = "", days: Number = "", grace: Number = "7") -> Done:
    """Set how often the series is tested; empty or 0: no date."""
    of = _series(asked, key).wanted
    late = _number(grace, "the grace")
    asked.history.set_interval(
        of.machine, _number(days, "the interval") or None, of.series, grace=7.0 if late is None else late, why=why
    )
    return Done(f"/settings/series/{key}", "How often this series is tested is kept.")


def _number(text: str, what: str) -> float | None:
    """A number as a person writes it, with a point or a comma; none for nothing."""
    text = text.strip().replace("\N{MINUS SIGN}", "-")
    if not text:
        return None
    try:
        return float(text.replace(",", ".") if text.count(",") == 1 and "." not in text else text)
    except ValueError:
        raise InputError(f"{what} is {text!r}; give a number, as 12.5") from None


def _whole(text: str, what: str) -> int:
    if not text.strip().isdecimal():
        raise InputError(f"{what} is {text.strip()!r}; give a whole number, as 10")
    return int(text)
