"""The view of an identification: the answer first, all else in sections."""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.estimate import Repeatability
from elastogeo.identification import CONDITION_LIMIT, Consistency, Identification, Level, ModelChoice, Parameter
from elastogeo.report.head import campaign_head, files_section, origin
from elastogeo.report.identification.budgets import budget_tables, degrees, uncertainty_table
from elastogeo.report.identification.collinear import collinear_section
from elastogeo.report.identification.document import identification_json
from elastogeo.report.identification.force_dependence import force_section
from elastogeo.report.identification.inseparable import inseparable_words
from elastogeo.report.identification.models import model_said, models_words, ratio_said, shown_models
from elastogeo.report.identification.pictures import picture
from elastogeo.report.identification.recovery import recovered_words, recovery_section
from elastogeo.report.identification.tests import information_table, test_table, together_words
from elastogeo.report.identification.words import (
    banner,
    confounding_words,
    has_influences,
    keep_in_mind,
    log_words,
    own_results_words,
    repeats_words,
    structure_words,
    uncertainty_words,
)
from elastogeo.report.numbers import pretty, probability, significant, value_with_uncertainty, written_unit
from elastogeo.report.text import (
    MOST_TERMS,
    ParameterRow,
    all_separated,
    combination,
    display_units,
    in_micrometres,
    label,
    labels,
    parameter_rows,
    reading_unit,
    said_value,
)
from elastogeo.report.view import KeyValue, Section, Table, View, attention_sentence, said, views

KEY_VALUES = 5
_MOVED = 1e-4
"""Of its uncertainty: a constrained value closer to the free one is the same on paper."""


@views(Identification)
def identification_view(result: Identification) -> View:
    """All that is shown of an identification."""
    campaign = result.campaign
    document = identification_json(result)
    inseparable = inseparable_words(campaign, result.confounding)
    return View(
        kind="Identification",
        title=campaign.machine.name,
        subtitle=campaign.name,
        origin=origin(campaign),
        head=campaign_head(campaign),
        sentence=answer(result),
        values=key_values(result),
        picture=picture("contributions" if campaign.several else "traces", result),
        checks=said(result.verdict),
        document=document,
        rows=document["parameters"],
        alert=(*banner(result), *(pretty(label(p)) for p in result.parameters if not p.separated)),
        tables=(*([test_table(result)] if campaign.several else []), parameter_table(result), level_table(result)),
        notes=(
            *together_words(result),
            *stands_for(result),
            *inseparable,
            *recovered_words(result),
            *log_words(campaign),
            *own_results_words(campaign),
        ),
        sections=tuple(_sections(result, inseparable)),
    )


def answer(result: Identification) -> str:
    """What moves the machine most, and how much of the question the test answers, in one sentence."""
    if not all_separated(result):
        count = sum(not p.separated for p in result.parameters)
        return f"Compliance and geometry are not separated in {count} combinations. {attention_sentence(result.verdict)}"
    found, of_machine = result.confounding, [p for p in result.parameters if p.axis]
    top = sorted(of_machine, key=lambda p: p.share, reverse=True)[:2]
    share = sum(p.share for p in top)
    determined = (
        f"all {found.rank} parameters are determined"
        if found.rank == len(found.labels)
        else f"{found.rank} of {len(found.labels)} parameters are determined, or sums of them"
    )
    if result.campaign.several:
        determined += f": {len(result.together) or 'none'} of them only by the {len(result.tests)} tests together"
    cause = " and ".join(label(p) for p in top)
    lead = f"{cause} {'cause' if len(top) > 1 else 'causes'} {100 * share:.0f} % of the deviation; " if top else ""
    text = f"{lead}{determined}."
    return f"{text[:1].upper()}{text[1:]} {attention_sentence(result.verdict)}"


def key_values(result: Identification) -> tuple[KeyValue, ...]:
    """The parameters that move the readings most."""
    rows = dict(zip((p.name for p in result.parameters), parameter_rows(result), strict=True))
    top = sorted((p for p in result.parameters if p.axis), key=lambda p: p.share, reverse=True)[:KEY_VALUES]
    return tuple(_key_value(p, rows[p.name]) for p in top)


def _key_value(parameter: Parameter, row: ParameterRow) -> KeyValue:
    return KeyValue(row.name, pretty(row.value), row.unit, pretty(_what_it_is(parameter, row.meaning)))


def _what_it_is(parameter: Parameter, meaning: str) -> str:
    """What a value means; of one that is a sum, the sum first: no member of it alone has this value."""
    if len(parameter.stands_for) == 1 or not parameter.separated:
        return meaning
    return f"the sum {combination(parameter.stands_for, MOST_TERMS)}; {meaning}"


def parameter_table(result: Identification) -> Table:
    """The identified parameters, the set-up last and without a share."""
    rows = zip(result.parameters, parameter_rows(result), strict=True)
    ordered = sorted(rows, key=lambda pair: not pair[0].axis)
    strongest, read = _strongest(result), reading_unit(result).name
    return Table(
        headings=("parameter", "value ± U (95 %)", "unit", f"peak to peak [{read}]", "share [%]", "meaning"),
        rows=tuple(
            (r.name, pretty(r.value), r.unit, pretty(r.peak_to_peak), r.share_percent if p.axis else "", r.meaning)
            for p, r in ordered
        ),
        words=(0, 2, 5),
        title="Parameters",
        note=f"U is half the 95 % interval. Peak to peak: the parameter's part of the trace at {strongest.force:g} "
        f"N, with the "
        f"sign of the parameter; its share is that of the sum of all parts of the machine.",
    )


def level_table(result: Identification) -> Table:
    """How well every force level is fitted, and what compliance and geometry do there."""
    both = all_separated(result) and {p.elastic for p in result.parameters if p.axis} == {True, False}
    headings: tuple[str, ...] = ("force [N]", "readings", f"RMSE [{reading_unit(result).name}]", "fitness [%]")
    rows = tuple(_level_row(result, level)[: 6 if both else 4] for level in result.levels)
    several = result.campaign.several
    headings = (*headings, "compliance [µm]", "geometry [µm]") if both else headings
    return Table(
        headings=("test", *headings) if several else headings,
        rows=tuple((level.test, *row) for level, row in zip(result.levels, rows, strict=True)) if several else rows,
        words=(0,) if several else (),
        title="Fit by force level",
        note="Fitness is 100 % less the RMSE in percent of the range of the readings (Eqs. 5.40, 5.41)."
        + (" Compliance and geometry: least to greatest deviation that each predicts (Figure 5.8)." if both else ""),
    )


def stands_for(result: Identification) -> tuple[str, ...]:
    """What each retained name stands for, where it is not itself alone."""
    return tuple(
        f"{p.name} stands for {combination(p.stands_for, MOST_TERMS)}"
        if p.separated
        else f"only the sum is known: {label(p)}"
        for p in result.parameters
        if len(p.stands_for) > 1
    )


def _sections(result: Identification, inseparable: tuple[str, ...]) -> Iterator[Section]:
    one = not result.campaign.several
    if not one:
        yield Section("The tests", together_words(result), tables=(test_table(result), information_table(result)))
    yield Section(
        "Parameters",
        paragraphs=tuple(structure_words(result)),
        pictures=(picture("contributions", result), *([picture("parts", result)] if one else [])),
        tables=(parameter_table(result),),
    )
    if one and {p.elastic for p in result.parameters if p.axis} == {True, False} and all_separated(result):
        yield Section("Compliance and geometry apart", pictures=(picture("separation", result),))
    yield Section("Fit", pictures=(picture("residuals", result),) if one else (), tables=(level_table(result),))
    if any(p.truth is not None for p in result.parameters):
        yield recovery_section(result)
    yield _uncertainty(result)
    if result.models is not None and result.models.supported is not None:
        yield _models(result, result.models)
    if result.local:
        yield force_section(result)
    if result.consistency is not None:
        yield _physics(result, result.consistency)
    yield from collinear_section(result)
    if result.repeats is not None:
        yield _repeats(result, result.repeats)
    yield _confounding(result, inseparable)
    yield _method(result)
    yield Section("What to keep in mind", points=tuple(map(pretty, keep_in_mind(result))))
    yield from files_section(result.campaign)


def _uncertainty(result: Identification) -> Section:
    words = tuple(map(pretty, uncertainty_words(result)))
    if not has_influences(result):
        return Section("Where the uncertainty comes from", words, tables=(uncertainty_table(result),))
    return Section(
        "Where the uncertainty comes from",
        words,
        (picture("budget", result),),
        budget_tables(result),
        note="Contributions are standard uncertainties, greatest first; type A from statistics of this test, type B from "
        "other knowledge; ν: degrees of freedom, combined by Welch and Satterthwaite.",
    )


def _models(result: Identification, models: ModelChoice) -> Section:
    shown = shown_models(models)
    rows = [
        (
            model_said(model.name) if model.exponent is None else f"{model_said(model.name)}, exponent {model.exponent:.2f}",
            str(model.parameters),
            in_micrometres(model.rmse),
            "–" if model.left_out_run is None else in_micrometres(model.left_out_run),
            "–" if model.left_out_level is None else in_micrometres(model.left_out_level),
            ratio_said(model),
            pretty(probability(model.p_value)),
        )
        for model in shown
    ]
    supported = next(k for k, model in enumerate(shown) if model.name == models.supported)
    table = Table(
        (
            "model",
            "parameters",
            "RMSE, all [µm]",
            "left-out runs [µm]",
            "left-out levels [µm]",
            "log of the ratio to the first",
            "lacks more, p",
        ),
        tuple(rows),
        strong=(supported,),
    )
    return Section("Which model do the data support?", tuple(models_words(models)), (picture("models", result),), (table,))


def _physics(result: Identification, found: Consistency) -> Section:
    units = display_units(result)
    rows = []
    for p in result.parameters:
        nearest, factor = found.constrained.get(p.name, p.value), units[p.name].factor
        if p.elastic and abs(nearest - p.value) > _MOVED * (p.standard_uncertainty or 0.0):
            free = pretty(said_value(p, units[p.name]))
            rows.append((p.name, free, pretty(significant(nearest * factor)), units[p.name].name))
    table = Table(
        ("parameter", "free estimate ± U (95 %)", "nearest that joints can have", "unit"), tuple(rows), words=(0, 3)
    )
    lead = "A joint's compliance is symmetric, and a load never gains energy. The estimate is free to violate that."
    check = next((check.sentence for check in said(result.verdict) if check.name == "physically consistent"), "")
    return Section("Does it agree with physics?", (lead, pretty(check)), tables=(table,) if rows else ())


def _repeats(result: Identification, repeats: Repeatability) -> Section:
    units, shown = display_units(result), labels(result)
    solution, bounds = repeats.solution, repeats.solution.interval()
    rows = []
    for k, name in enumerate(solution.labels):
        unit, value = units[name], float(solution.values[k])
        half = float(bounds[k, 1] - value) * unit.factor
        spread = (float(solution.standard_uncertainty[k]), float(repeats.combination_std[k]))
        uncertainty, deviation = (pretty(significant(size * unit.factor, 2)) for size in spread)
        estimate = pretty(value_with_uncertainty(value * unit.factor, half))
        freedom = degrees(float(solution.degrees_of_freedom[k]))
        rows.append((pretty(shown[name]), estimate, unit.name, uncertainty, freedom, deviation))
    headings = ("parameter", "estimate ± U (95 %)", "unit", "u of the estimate", "ν", "standard deviation of combinations")
    return Section(
        "Repeats",
        tuple(map(pretty, repeats_words(result))),
        (picture("repeats", result),),
        (Table(headings, tuple(rows), words=(0, 2)),),
    )


def _confounding(result: Identification, inseparable: tuple[str, ...]) -> Section:
    found = result.confounding
    whole = found.rank == len(found.labels)
    rows = tuple(
        (p.name if p.separated else "only the sum is known", pretty(combination(p.stands_for)))
        for p in result.parameters
        if len(p.stands_for) > 1
    )
    facts = Table(
        ("", ""),
        (
            ("rank", f"{found.rank} of {len(found.labels)}"),
            ("condition number, scaled columns", f"{significant(found.condition_scaled)} (limit {CONDITION_LIMIT:g})"),
            ("condition number, raw columns", significant(found.condition_raw)),
            ("singular values, scaled", ", ".join(significant(value) for value in found.singular_values)),
            ("changes no reading", ", ".join(found.null) or "none"),
        ),
        words=(0, 1),
    )
    tables = (Table(("parameter", "stands for"), rows, words=(0, 1)), facts) if rows else (facts,)
    return Section(
        f"What this test {'distinguishes' if whole else 'cannot distinguish'}",
        tuple(map(pretty, (*confounding_words(found), *inseparable))),
        (picture("patterns", result),) if not result.campaign.several else (),
        tables,
    )


def _method(result: Identification) -> Section:
    reference = result.reference_force
    points = [
        "A reading is the projection of the tool-to-workpiece displacement on the instrument's sensitive direction; each "
        "parameter's column follows in closed form from the machine's Jacobian (Eq. 4.13), to first order.",
        "" if reference is None else f"The readings at {reference:g} N are subtracted from all others (Eqs. 4.26, 4.27).",
        "The global estimate is one least-squares solution over all force levels (Eqs. 4.28, 5.37), by orthogonal "
        "factorisation; local estimates use neighbouring levels (Eq. 4.29).",
        "Rank is decided on columns scaled to unit length; nothing is cut in silence.",
        _unit_notes(result),
        "Intervals follow JCGM 100 (GUM), with Student's t"
        + ("; the covariance is by run, with effective degrees of freedom." if result.by_run else "."),
        "Equation and figure numbers are those of B. Beglarzadeh, Metrology of machine tool compliance under quasi-static "
        "condition, Polytechnique Montréal.",
    ]
    return Section("How it was computed", points=tuple(point for point in points if point))


def _strongest(result: Identification) -> Level:
    return max(result.levels, key=lambda level: abs(level.force))


def _level_row(result: Identification, level: Level) -> tuple[str, ...]:
    own, read = reading_unit(result, level.test), reading_unit(result)
    return (
        f"{level.force:g}",
        str(level.readings),
        f"{significant(level.rmse * own.factor)}{'' if own == read else f' {own.name}'}",
        significant(level.fitness, 4),
        *(pretty(f"{in_micrometres(low)} to {in_micrometres(high)}") for low, high in (level.elastic, level.geometric)),
    )


def _unit_notes(result: Identification) -> str:
    """Each shown unit in those of the house."""
    by_name = display_units(result)
    notes = dict.fromkeys(_unit_note(p, by_name[p.name].name, by_name[p.name].factor) for p in result.parameters)
    return f"{pretty('; '.join(note for note in notes if note))}." if any(notes) else ""


def _unit_note(parameter: Parameter, shown: str, factor: float) -> str:
    return "" if factor == 1 else f"1 {shown} = {significant(1 / factor, 1)} {written_unit(parameter.unit)}"
