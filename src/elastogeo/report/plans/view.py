"""The view of a plan: where in the volume the tests lie, what they will tell, what comes next."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from elastogeo.planning import ALONE, IN_A_SUM, UNSEEN, Expectation, Plan
from elastogeo.report.ceilings import reason_words
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.numbers import display_unit, pretty, significant, whole_percent
from elastogeo.report.plans.document import plan_json
from elastogeo.report.plans.rows import PER_NEWTON, test_table, what_of, where_of
from elastogeo.report.text import MOST_TERMS, combination, listed
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_GOALS = {
    "workspace": "compliance at the tool over the volume",
    "parameters": "parameters known by themselves",
    "information": "information on all parameters",
}
_WORDS = {ALONE: "known alone", IN_A_SUM: "known in a sum", UNSEEN: "not seen"}
_HOUR = 60.0
_MOST_REASONS = 3
_MOST_VALUES = 2


@views(Plan)
def plan_view(plan: Plan) -> View:
    """All that is shown of a plan."""
    machine, document = plan.means.machine, plan_json(plan)
    tests, workspace = test_table(plan), _workspace_table(plan)
    return View(
        kind="Plan",
        title=machine.name,
        subtitle=f"{_tests(plan)} for the {_GOALS[plan.goal]}",
        origin="",
        head=tuple(_head(plan)),
        sentence=_sentence(plan),
        values=tuple(_values(plan)),
        picture=Picture(
            "volume",
            "The travel of the linear axes from three sides, and the path of each test in it, numbered in the order of "
            "doing. Paths are axis commands.",
            "Where in the volume the tests lie",
            lambda: _drawn("volume_figure", plan),
        ),
        checks=said(plan.verdict),
        document=document,
        rows=document["tests"],
        tables=(tests, workspace),
        notes=tuple(_notes(plan)),
        sections=(
            Section(
                "What each test adds",
                pictures=(_picture("growth", plan, "Workspace supported and greatest uncertainty, test by test"),),
                tables=(tests, workspace),
            ),
            Section(
                "What will be known of each parameter",
                paragraphs=(
                    "The compliance matrix of each joint: rows are displacements, columns loads, X Y Z along and A B C "
                    "about the axes. A parameter in a sum is known together with others that no test here tells from it.",
                ),
                pictures=(_picture("knowledge", plan, "What the plan will tell of each compliance"),),
                tables=(_parameter_table(plan),),
            ),
            Section("What stays unknown, and what comes next", points=tuple(_notes(plan))),
            Section("How it was worked out", points=tuple(_assumptions(plan))),
        ),
    )


def _sentence(plan: Plan) -> str:
    counts = Counter(p.known for p in plan.parameters)
    told = (
        f"{_tests(plan)} in {_duration(plan.minutes)} {'determines' if len(plan.tests) == 1 else 'determine'} {plan.rank} "
        f"of at most {plan.highest_rank} combinations of {len(plan.parameters)} compliances, {counts[ALONE]} of them alone"
    )
    if plan.asked:
        alone = [p.name for p in plan.parameters if p.name in plan.asked and p.known == ALONE]
        return f"{told}: {_known_of_the_asked(alone, len(plan.asked))}."
    return f"{told}, and support the compliance at the tool in {whole_percent(plan.supported)} % of the volume."


def _known_of_the_asked(alone: Sequence[str], asked: int) -> str:
    """Which of the named parameters will be known by themselves."""
    if not alone:
        return "none of what was asked for"
    return f"all that was asked for ({listed(alone)})" if len(alone) == asked else listed(alone)


def _values(plan: Plan) -> Iterator[KeyValue]:
    worst = max((tool.worst for tool in plan.tools if tool.worst is not None), default=None)
    yield KeyValue("tests", str(len(plan.tests)), "", "in the plan")
    yield KeyValue("time", f"{plan.minutes:.0f}", "min", "set-up and runs")
    yield KeyValue("rank", f"{plan.rank} of {plan.highest_rank}", "", "combinations determined")
    if plan.asked:
        yield from (_value(p) for p in [p for p in plan.parameters if p.name in plan.asked][:_MOST_VALUES])
        return
    yield KeyValue("supported", whole_percent(plan.supported), "%", "of the workspace")
    if worst is not None:
        unit = display_unit(PER_NEWTON, 2 * worst)
        yield KeyValue("U", significant(2 * worst * unit.factor), unit.name, "of the compliance at the tool, at worst")


def _value(p: Expectation) -> KeyValue:
    """What will be known of a parameter that was asked for."""
    if p.known != ALONE or p.standard_uncertainty is None:
        return KeyValue(p.name, _WORDS[p.known], "", p.meaning)
    unit = display_unit(p.unit, 2 * p.standard_uncertainty)
    return KeyValue(p.name, f"U = {significant(2 * p.standard_uncertainty * unit.factor)}", unit.name, p.meaning)


def _head(plan: Plan) -> Iterator[tuple[str, str]]:
    machine = plan.means.machine
    yield "Machine", f"{machine.name}, {machine.topology.compact} {machine.topology.iso}"
    yield "Goal", _GOALS[plan.goal]
    if plan.asked:
        yield "Asked for", ", ".join(plan.asked)
    if plan.made is not None:
        yield "Made already", ", ".join(plan.made.tests)
    yield "Instruments", ", ".join(dict.fromkeys(one.candidate.test.instrument for one in plan.tests))
    yield "Forces", ", ".join(f"{force:g} N" for force in plan.means.forces)
    yield "Tool points", "; ".join(pretty(", ".join(f"{part:g}" for part in tool)) for tool in plan.means.tool_points)


def _notes(plan: Plan) -> Iterator[str]:
    more = plan.next_best
    if more is not None:
        unit = display_unit(PER_NEWTON, more.worst)
        yield pretty(
            f"Next best: {more.candidate.name} ({what_of(more.candidate)}; {where_of(more.candidate)}): rank {more.rank}, "
            f"worst u {significant(more.worst * unit.factor)} {unit.name} with the prior, "
            f"{whole_percent(more.supported)} % supported."
        )
    if plan.fewest is not None and plan.goal == "workspace" and plan.fewest < len(plan.tests):
        yield f"{plan.fewest} tests could support the whole volume, less surely; the others make it surer."
    for p in plan.parameters:
        if p.name in plan.asked:
            yield _said(p)
    if plan.proposed:
        added = ", ".join(one.replace("-", " ") for one in plan.proposed)
        yield f"Tests of {added} were added: those that were offered do not tell what was asked for by itself."
    yield from map(reason_words, plan.reasons[:_MOST_REASONS])
    if len(plan.reasons) > _MOST_REASONS:
        yield f"{len(plan.reasons) - _MOST_REASONS} more parameters are known by no test between tool and workpiece."


def _said(p: Expectation) -> str:
    if p.standard_uncertainty is None:
        return f"{p.name}: not seen."
    unit = display_unit(p.unit, 2 * p.standard_uncertainty)
    size = f"U = {significant(2 * p.standard_uncertainty * unit.factor)} {unit.name}"
    if p.known == ALONE:
        return f"{p.name}: known alone, {size} expected."
    return f"{p.name}: known only within {combination(p.stands_for, MOST_TERMS)}, {size} expected of the sum."


def _parameter_table(plan: Plan) -> Table:
    rows = tuple(
        (
            p.name,
            _WORDS[p.known],
            "" if p.known == ALONE else combination(p.stands_for, MOST_TERMS),
            *_size(p),
        )
        for p in sorted(plan.parameters, key=lambda p: (ALONE, IN_A_SUM, UNSEEN).index(p.known))
    )
    return Table(
        ("parameter", "class", "sum", "expected U", "unit", "expected size"),
        rows,
        words=(0, 1, 2, 4),
        note="U of the parameter, or of the sum, from the readings alone, for 95 %. The expected size is that of the prior.",
    )


def _size(p: Expectation) -> tuple[str, str, str]:
    u = p.standard_uncertainty
    unit = display_unit(p.unit, p.scale)
    return "" if u is None else significant(2 * u * unit.factor), unit.name, significant(p.scale * unit.factor)


def _workspace_table(plan: Plan) -> Table:
    unit = display_unit(PER_NEWTON, max(tool.worst or tool.worst_with_prior for tool in plan.tools))
    rows = tuple(
        (
            pretty(", ".join(f"{part:g}" for part in tool.tool)),
            whole_percent(tool.share),
            "" if tool.median is None else significant(tool.median * unit.factor),
            "" if tool.worst is None else significant(tool.worst * unit.factor),
            significant(tool.worst_with_prior * unit.factor),
            "none do" if tool.tests_needed is None else str(tool.tests_needed),
            "none do" if tool.more_needed is None else str(tool.more_needed),
        )
        for tool in plan.tools
    )
    return Table(
        (
            "tool point [mm]",
            "supported [%]",
            f"median u [{unit.name}]",
            f"worst u [{unit.name}]",
            f"worst with prior [{unit.name}]",
            "tests to support all",
            "beside these",
        ),
        rows,
        words=(0,),
        title="Compliance at the tool over the volume",
        note="Standard uncertainties of the compliance along a direction, before the calibration of the force: that adds "
        "its share of the compliance. The last columns: how many tests support all of it at least, and how many it takes "
        "beside the plan.",
    )


def _assumptions(plan: Plan) -> Iterator[str]:
    noise = plan.noise
    yield (
        f"A reading scatters by {1000 * noise.reading:g} µm; from run to run centre, bar length and zeros wander by "
        f"{1000 * noise.set_up:g} µm, the force by {100 * noise.force:g} %. Systematic influences come on top."
    )
    yield (
        "What does not go with the force (geometry, set-up) may be anything at each pose: only differences between force "
        "levels count."
    )
    yield (
        "The stated prior: each compliance has a standard deviation of its expected size, 5 nm/N for a translation and a "
        "force, with a lever of 300 mm for rotations and moments. It enters the choice, and what is with the prior."
    )
    yield (
        f"{plan.candidates} tests were drawn within the travel; bar, spindle and table keep clear by angles alone. Drive "
        f"every path once without the instrument."
    )
    yield "Other machine faults than compliance are not planned for."


def _tests(plan: Plan) -> str:
    return "1 test" if len(plan.tests) == 1 else f"{len(plan.tests)} tests"


def _duration(minutes: float) -> str:
    return f"{minutes:.0f} min" if minutes < 2 * _HOUR else f"{minutes / _HOUR:.1f} h"


def _picture(name: str, plan: Plan, caption: str) -> Picture:
    return Picture(name, f"{caption}.", caption, lambda: _drawn(f"{name}_figure", plan))


def _drawn(name: str, plan: Plan) -> Figure:
    with needs_report_extra():
        from elastogeo.report.plans import figures
    draw: Callable[[Plan], Figure] = getattr(figures, name)
    return draw(plan)
