"""The verdict of a static test: checks of all runs gathered into one each, with a sentence a person can act on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.special import fdtrc

from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis
from elastogeo.identification.static_tests.result import Cartesian, LoadedPlace, LoadedRun, TwistRun
from elastogeo.observe import KnownInfluence

UM = 1000.0
FALSE_ALARM = 0.01
"""Rate at which a sound test fails a check, over all its runs."""


def loading_checks(places: Sequence[LoadedPlace]) -> tuple[Check, ...]:
    """Of a static force: cycles, signs, energy, straightness, drives."""
    loaded = [run for place in places for run in place.runs]
    cycled = [run for run in loaded if run.hysteresis is not None]
    along = [run for place in places if place.along for run in place.runs if run.hysteresis is not None]
    checks = [_cycles(loaded)]
    if along:
        checks.append(
            _signed(
                "displacement with the force",
                along,
                lambda found: found.static_compliance,
                "static compliance, um/N",
                "the displacement goes against the force: turn the sensor's sign",
            )
        )
        checks.append(
            _signed(
                "energy is lost, not gained",
                along,
                lambda found: found.mean_hysteresis,
                "mean hysteresis, um",
                "the loop runs the wrong way round: force and displacement may be shifted in time against each other, or a "
                "sign is wrong",
            )
        )
    if cycled:
        checks.append(_by_cycle(cycled))
    checks += [check for place in places if (check := _straight(place)) is not None]
    for place in places:
        if place.drive is not None:
            name = place.drive.axis
            checks += [replace(check, name=f"drive of {name}: {check.name}") for check in place.drive.verdict]
        elif place.drive_refusal:
            checks.append(Check("drive told apart", False, {"said": _sentence(place.drive_refusal)}))
    return tuple(checks)


def probe_checks(found: Cartesian) -> tuple[Check, ...]:
    """Of displacement probes: determined, symmetric, no energy gained."""
    if found.symmetry is None:
        reason = found.refusal or "the symmetry of the compliance cannot be judged"
        return (Check("compliance determined", not found.compliance.undetermined, {"said": _sentence(reason)}),)
    checks = found.compliance.checks()
    zeros = Check(
        "zeros of the probes",
        True,
        {
            "said": "The probes count as zeroed without load, because no zero was asked for; else ask for E_Xw0, E_Yw0, E_Zw0."
            if found.zeroed
            else "The zero of each probe is estimated with the compliance."
        },
    )
    by_run = found.compliance.by_run
    counted = Check(
        "Cartesian uncertainty by run",
        by_run,
        {
            "said": "The uncertainties of the Cartesian compliance come from the scatter of the runs."
            if by_run
            else "The uncertainties of the Cartesian compliance count on independent readings, because the runs are too few; "
            "readings along a turn rarely are: repeat the runs."
        },
    )
    return (*(replace(check, decisive=check.name == "no energy gained") for check in checks), zeros, counted)


def twist_checks(runs: Sequence[TwistRun], refusal: str) -> tuple[Check, ...]:
    """Of a sensor frame: whether it sees the twist, and whether its sensors agree."""
    if not runs:
        return (Check("twist determined", False, {"said": _sentence(refusal)}),)
    seen = Check("twist determined", True, {"said": "The sensors determine all six components of the twist."})
    suspects = {run.run: run.twist.suspect for run in runs if run.twist.suspect is not None}
    unchecked = [str(k + 1) for k, share in enumerate(runs[0].twist.redundancy) if np.isnan(runs[0].twist.outlying[k])]
    if suspects:
        said = ", ".join(f"sensor {sensor} in run {run}" for run, sensor in suspects.items())
        return seen, Check(
            "sensors agree",
            False,
            {
                "said": f"By more than the scatter of the others stands out: {said}. Look at how it touches, and at its cable; leave it "
                f"out if it stays so."
            },
        )
    if unchecked:
        return seen, Check("sensors agree", False, {"said": f"Nothing checks sensor {', '.join(unchecked)}; add sensors."})
    return seen, Check(
        "sensors agree", True, {"said": f"No sensor stands out of the {len(runs[0].twist.redundancy)}, in any run."}
    )


def influence_checks(influences: Sequence[KnownInfluence]) -> tuple[Check, ...]:
    """What the test states of systematic influences, and where it does not count; nothing if it states none."""
    if not influences:
        return ()
    named = ", ".join(influence.label or influence.kind for influence in influences)
    return (
        Check(
            "systematic influences",
            False,
            {
                "said": f"The uncertainties of the joints hold those of {named}; those of the instrument's own results (loops, line, "
                f"matrix, twist) do not: they are of repeatability alone."
            },
        ),
    )


def _cycles(loaded: Sequence[LoadedRun]) -> Check:
    without = [run for run in loaded if run.hysteresis is None]
    cycles = sum(len(run.hysteresis.cycles) for run in loaded if run.hysteresis is not None)
    if not without:
        return Check("loading cycles", True, {"said": f"{cycles} cycles of loading and unloading in {len(loaded)} runs."})
    return Check(
        "loading cycles",
        False,
        {
            "said": f"{len(without)} of {len(loaded)} runs say nothing of hysteresis. Run {without[0].run}: {without[0].refusal}."
        },
    )


def _signed(
    name: str, runs: Sequence[LoadedRun], of: Callable[[StaticHysteresis], Estimate], what: str, wrong: str
) -> Check:
    """Whether a number that must be positive is so in every run, to within its uncertainty; decisive."""
    values = [(run.run, of(run.hysteresis)) for run in runs if run.hysteresis is not None]
    coverage = 1 - 2 * FALSE_ALARM / len(values)
    bad = [(run, value) for run, value in values if value.interval(coverage)[1] < 0]
    if bad:
        said = ", ".join(f"{value.value * UM:.4g} in run {run}" for run, value in bad)
        return Check(name, False, {"said": f"{what[0].upper()}{what[1:]}: {said}; {wrong}."}, decisive=True)
    sizes = [value.value * UM for _, value in values]
    extent = f"{min(sizes):.4g} to {max(sizes):.4g}" if len(sizes) > 1 else f"{sizes[0]:.4g}"
    return Check(name, True, {"said": f"{what[0].upper()}{what[1:]}: {extent}."}, decisive=True)


def _by_cycle(runs: Sequence[LoadedRun]) -> Check:
    single = [run.run for run in runs if run.hysteresis is not None and not run.hysteresis.by_cycle]
    if not single:
        return Check(
            "uncertainty by cycle", True, {"said": "The uncertainties of each run come from the scatter of its cycles."}
        )
    return Check(
        "uncertainty by cycle",
        False,
        {
            "said": f"One cycle only in run {', '.join(single)}: the uncertainties count on independent readings and do not say how a "
            f"second cycle would differ; load it three times at least."
        },
    )


def _straight(place: LoadedPlace) -> Check | None:
    """Whether the straight line scatters as the curves through the branches do; None without a curve for every run."""
    found = [run.hysteresis for run in place.runs]
    if place.line is None or any(one is None for one in found):
        return None
    freedom = sum(one.curves.degrees_of_freedom for one in found if one is not None)
    left = sum(one.curves.degrees_of_freedom * one.residual_std**2 for one in found if one is not None)
    curved = np.sqrt(left / freedom)
    line = place.line
    if not curved:
        return None
    ratio = (line.residual_std / curved) ** 2
    straight = bool(fdtrc(line.compliance.degrees_of_freedom, freedom, ratio) >= FALSE_ALARM)
    said = f"The straight line leaves {line.residual_std * UM:.3g} um, curves through the branches {curved * UM:.3g} um"
    return Check(
        "straight line enough",
        straight,
        {
            "said": f"{said}."
            if straight
            else f"{said}: hysteresis, curvature, or zeros that differ from run to run are more than scatter; take the line's "
            f"compliance as a mean over the range."
        },
    )


def _sentence(reason: str) -> str:
    return f"{reason[:1].upper()}{reason[1:]}{'' if reason.endswith('.') else '.'}"
