"""The view of what a person is told of an alarm, and `elastogeo.alarm/1`, its document.

step : `open`, `worse`, `released`, `closed as repaired` or `closed as false`
alarm : {number, machine, series, instrument, state, opened, over, confirmed, who, why, at, holds, silent_until,
    simulated, place, since, points_to, held_by}; `over` is by indicator how many limits it was off at most; `since` is when
    the machine changed; `holds` are machines whose alarms an instrument's alarm holds back, `held_by` is the number of the
    alarm that holds this one back
change : the document of the verdict that caused it, `elastogeo.change/1` without its chart, or null
simulated : from what the tests are simulated, or null
"""

from __future__ import annotations

from elastogeo.changes.alarms import FALSE, OPEN, RELEASED, REPAIRED, WORSE, AlarmNews
from elastogeo.report.alarms.words import entry, of_what, over_said
from elastogeo.report.days import date_said, simulated_said
from elastogeo.report.document import document
from elastogeo.report.text import listed
from elastogeo.report.view import View, view_of, views

SCHEMA = "elastogeo.alarm/1"
_KINDS = {
    OPEN: "Alarm",
    WORSE: "Alarm, worse",
    RELEASED: "Alarm counts again",
    REPAIRED: "Alarm closed as repaired",
    FALSE: "Alarm closed as false",
}


@views(AlarmNews)
def alarm_news_view(result: AlarmNews) -> View:
    """What a person is told of one change of state."""
    row = result.alarm
    verdict = None if result.verdict is None else view_of(result.verdict)
    found = {
        "step": result.step,
        "alarm": entry(row),
        "change": None
        if verdict is None
        else {name: verdict.document[name] for name in verdict.document if name != "chart"},
        "simulated": result.simulated or None,
    }
    return View(
        kind=_KINDS[result.step],
        title=of_what(row),
        origin=simulated_said(result.simulated),
        head=(("Alarm", str(row.number)), ("Opened", date_said(row.opened))),
        sentence=_answer(result) if verdict is None else verdict.sentence,
        document=document(SCHEMA, found),
        advice=() if verdict is None else verdict.advice,
        notes=_beside(result),
    )


def _answer(result: AlarmNews) -> str:
    row = result.alarm
    of = of_what(row)
    if result.step == REPAIRED:
        after = "It needs a calibration." if row.instrument else "Its series needs a new baseline."
        return f"{row.who} closed the alarm of {of} as repaired: {row.why}. {after}"
    if result.step == FALSE:
        after = "Machines that it held back count again." if row.instrument else "Its baseline stays."
        return f"{row.who} closed the alarm of {of} as false: {row.why}. {after}"
    if result.step == RELEASED:
        return f"The instrument is not the cause: the alarm of {of} counts again ({over_said(row.over)})."
    if row.instrument:
        return (
            f"{of[:1].upper()}{of[1:]} seems to have changed: {listed(row.holds)} moved alike with it. Their alarms are "
            f"held back; check or recalibrate the instrument."
        )
    return f"{of} has changed: {over_said(row.over)}."


def _beside(result: AlarmNews) -> tuple[str, ...]:
    row = result.alarm
    opened = f"Alarm {row.number} is open since {date_said(row.opened)}."
    if result.step in (REPAIRED, FALSE):
        return (f"Alarm {row.number} was open since {date_said(row.opened)}.",)
    if result.step == WORSE:
        return (f"It is worse than when it was last told: {over_said(row.over)}.", opened, _answer_it(row.number))
    return (opened, _answer_it(row.number))


def _answer_it(number: int) -> str:
    return f"To say that you know of it: elastogeo history acknowledge {number} --why '...'"
