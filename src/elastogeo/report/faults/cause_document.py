"""What the page of a circular test shows beside its view: ranked causes with their sliders, polar plots, columns.

causes : [{names, title, name, value, unit, distortion, uncertainty, share, length, kind, sure, sentence, together}], as they
    are shown: `length` is that of its bar in percent of the longest, `sure` whether its interval excludes zero, `together`
    what moves with it since the test cannot tell it apart
polars : [{force_N, title, note, plot, centre, radius, per_um}], a drawing for each force level, the highest first
columns : as in `columns`
heading, lead, extent : what the causes are given at; the answer in words; how far the circle runs out
untold : [sentence], what this test says nothing of, in short
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any

from elastogeo.identification import CauseParts, Diagnosis, Fault, Identification, cause_parts
from elastogeo.report.faults.columns import columns_document, for_a_page
from elastogeo.report.faults.polar import polars
from elastogeo.report.faults.rows import YES, DiagnosisRow, described, diagnosis_rows
from elastogeo.report.identification.figures.contributions import kind_of
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty, whole_percent
from elastogeo.report.text import UM, combination, listed

_NAMED = 4
"""Names that are said in a sentence before the others are counted."""


def causes_document(result: object) -> dict[str, Any] | None:
    """The ranked causes of a circular test with all that its page draws and computes; None of any other result.

    Parameters
    ----------
    result : object
        An identification or a diagnosis has causes.
    """
    if not isinstance(result, Identification | Diagnosis) or (
        isinstance(result, Identification) and result.campaign.several
    ):
        return None
    parts = for_a_page(cause_parts(result))
    if not parts.runs:
        return None
    return {
        "heading": f"peak to peak at {max((run.force for run in parts.runs), key=abs):g} N, 95 %",
        "lead": _lead(parts),
        "extent": _extent(parts),
        "untold": list(_untold(parts)),
        "causes": _causes(parts),
        "polars": [polar.to_dict() for polar in polars(parts)],
        "columns": columns_document(parts),
    }


def _causes(parts: CauseParts) -> list[dict[str, Any]]:
    result = parts.diagnosis.identification
    rows = [row for row in diagnosis_rows(parts.diagnosis) if row.rank]
    longest = max((abs(cause.distortion) for cause in parts.causes), default=0.0) or 1.0
    return [_cause(result, cause, row, longest) for cause, row in zip(parts.causes, rows, strict=True)]


def _with_half(cause: Fault) -> tuple[str, str]:
    """Peak to peak [µm] and the half of its 95 % interval, to the same place; no half where there is no interval."""
    size, spread = abs(cause.distortion) * UM, cause.distortion_estimate
    if spread is None:
        return significant(size), ""
    number, _, half = value_with_uncertainty(size, spread.expanded() * UM).partition(" ± ")
    return (number, half) if not number.startswith("(") else (significant(size), significant(spread.expanded() * UM, 2))


def _cause(result: Identification, cause: Fault, row: DiagnosisRow, longest: float) -> dict[str, Any]:
    shown = described(cause, result)
    size, half = _with_half(cause)
    return {
        "names": list(shown.names),
        "title": f"{row.meaning[:1].upper()}{row.meaning[1:]}",
        "name": row.name,
        "value": pretty(row.value),
        "unit": row.unit,
        "distortion": size,
        "uncertainty": half,
        "share": row.share_percent,
        "length": round(100 * abs(cause.distortion) / longest, 1),
        "kind": _kind(result, cause),
        "sure": row.significant == YES,
        "sentence": row.sentence,
        "together": listed(shown.also) if shown.also else "",
    }


def _kind(result: Identification, cause: Fault) -> str:
    return kind_of(result, [p for p in result.parameters if p.name in cause.names]).partition(",")[0]


def _lead(parts: CauseParts) -> str:
    """How much of the deviation comes from what."""
    result = parts.diagnosis.identification
    by_kind = sorted(((_kind(result, cause), cause.share) for cause in parts.causes), key=lambda pair: pair[0])
    shares = {kind: sum(share for _, share in pairs) for kind, pairs in groupby(by_kind, key=lambda pair: pair[0])}
    ranked = sorted(shares.items(), key=lambda pair: -pair[1])
    strongest = max((run.force for run in parts.runs), key=abs)
    causes = [f"{kind} {'makes' if not k else ''} {whole_percent(share)} %" for k, (kind, share) in enumerate(ranked)]
    said = " ".join(f"{listed(causes)} of the deviation at {strongest:g} N.".split())
    return f"{said[:1].upper()}{said[1:]}"


def _extent(parts: CauseParts) -> str:
    """How far the traces run out at the greatest and the least force."""
    forces = sorted({run.force for run in parts.runs}, key=abs, reverse=True)
    ends = []
    for force in dict.fromkeys((forces[0], forces[-1])):
        found = parts.diagnosis.circularity[force]
        lows = [low for low in (found.f_min_ccw, found.f_min_cw) if low is not None]
        highs = [high for high in (found.f_max_ccw, found.f_max_cw) if high is not None]
        if lows and highs:
            low, high = (_signed(value * UM) for value in (min(lows), max(highs)))
            ends.append(f"from {low} to {high} µm at {force:g} N")
    return f"The circle runs {', '.join(ends)}." if ends else ""


def _untold(parts: CauseParts) -> Iterator[str]:
    """What changes no reading, and what only sums of are known."""
    null = parts.diagnosis.untold
    if null:
        more = len(null) - _NAMED
        names = listed(null) if more < 2 else f"{', '.join(null[:_NAMED])} and {more} more"
        yield f"No reading depends on {names}."
    sums = [p for p in parts.diagnosis.identification.parameters if len(p.stands_for) > 1]
    if sums:
        first = combination(sums[0].stands_for, _NAMED)
        others = f", and {len(sums) - 1} more such sums" if len(sums) > 2 else ", and one more" if len(sums) == 2 else ""
        yield f"Only the sum {pretty(first)} is known{others}."


def _signed(value: float) -> str:
    return pretty(f"{'+' if value > 0 else ''}{significant(value)}")
