"""The verdict of a static test: checks of all runs gathered into one each, with their facts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.special import fdtrc

from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis, signed_facts
from elastogeo.identification.static_tests.result import Cartesian, LoadedPlace, LoadedRun, TwistRun
from elastogeo.observe import KnownInfluence

FALSE_ALARM = 0.01
"""Rate at which a sound test fails a check, over all its runs."""


def loading_checks(places: Sequence[LoadedPlace]) -> tuple[Check, ...]:
    """Of a static force: cycles, signs, energy, straightness, drives."""
    loaded = [run for place in places for run in place.runs]
    cycled = [run for run in loaded if run.hysteresis is not None]
    along = [run for place in places if place.along for run in place.runs if run.hysteresis is not None]
    checks = [_cycles(loaded)]
    if along:
        checks.append(_signed("displacement with the force", along, lambda found: found.static_compliance))
        checks.append(_signed("energy is lost, not gained", along, lambda found: found.mean_hysteresis))
    if cycled:
        checks.append(_by_cycle(cycled))
    checks += [check for place in places if (check := _straight(place)) is not None]
    for place in places:
        if place.drive is not None:
            name = place.drive.axis
            checks += [replace(check, name=f"drive of {name}: {check.name}") for check in place.drive.verdict]
        elif place.drive_refusal:
            checks.append(Check("drive located", None, {"why": place.drive_refusal}))
    return tuple(checks)


def probe_checks(found: Cartesian) -> tuple[Check, ...]:
    """Of displacement probes: determined, symmetric, no energy gained."""
    if found.symmetry is None:
        why = found.refusal or "the symmetry of the compliance cannot be judged"
        return (Check("compliance determined", not found.compliance.undetermined, {"why": why}),)
    checks = found.compliance.checks()
    zeros = Check("zeros of the probes", True, {"zeroed": found.zeroed})
    counted = Check("Cartesian uncertainty by run", found.compliance.by_run)
    return (*(replace(check, decisive=check.name == "no energy gained") for check in checks), zeros, counted)


def twist_checks(runs: Sequence[TwistRun], refusal: str) -> tuple[Check, ...]:
    """Of a sensor frame: whether it sees the twist, and whether its sensors agree."""
    if not runs:
        return (Check("twist determined", False, {"why": refusal}),)
    suspects = {run.run: run.twist.suspect for run in runs if run.twist.suspect is not None}
    unchecked = tuple(k + 1 for k in range(len(runs[0].twist.redundancy)) if np.isnan(runs[0].twist.outlying[k]))
    facts = {"sensors": len(runs[0].twist.redundancy), "suspects": suspects, "unchecked": unchecked}
    agree = False if suspects else None if unchecked else True
    return Check("twist determined", True, {"why": ""}), Check("sensors agree", agree, facts)


def influence_checks(influences: Sequence[KnownInfluence]) -> tuple[Check, ...]:
    """What the test states of systematic influences, and where it does not count; nothing if it states none."""
    if not influences:
        return ()
    named = tuple(influence.label or influence.kind for influence in influences)
    return (Check("systematic influences in the instrument's own results", False, {"stated": named}),)


def _cycles(loaded: Sequence[LoadedRun]) -> Check:
    without = [run for run in loaded if run.hysteresis is None]
    facts = {
        "cycles": sum(len(run.hysteresis.cycles) for run in loaded if run.hysteresis is not None),
        "runs": len(loaded),
        "without": len(without),
        "run": without[0].run if without else "",
        "why": without[0].refusal if without else "",
    }
    return Check("loading cycles", not without, facts)


def _signed(name: str, runs: Sequence[LoadedRun], of: Callable[[StaticHysteresis], Estimate]) -> Check:
    """Whether a number that must be positive is so in every run, to within its uncertainty; decisive."""
    values = {run.run: of(run.hysteresis) for run in runs if run.hysteresis is not None}
    coverage = 1 - 2 * FALSE_ALARM / len(values)
    wrong = {run: value for run, value in values.items() if value.interval(coverage)[1] < 0}
    return Check(name, not wrong, signed_facts(values, wrong), decisive=True)


def _by_cycle(runs: Sequence[LoadedRun]) -> Check:
    single = tuple(run.run for run in runs if run.hysteresis is not None and not run.hysteresis.by_cycle)
    cycles = sum(len(run.hysteresis.cycles) for run in runs if run.hysteresis is not None)
    return Check("uncertainty by cycle", not single, {"cycles": cycles, "single": single})


def _straight(place: LoadedPlace) -> Check | None:
    """Whether the straight line scatters as the curves through the branches do; None without a curve for every run."""
    found = [run.hysteresis for run in place.runs]
    if place.line is None or any(one is None for one in found):
        return None
    freedom = sum(one.curves.degrees_of_freedom for one in found if one is not None)
    left = sum(one.curves.degrees_of_freedom * one.residual_std**2 for one in found if one is not None)
    curved = float(np.sqrt(left / freedom))
    line = place.line
    if not curved:
        return None
    ratio = (line.residual_std / curved) ** 2
    straight = bool(fdtrc(line.compliance.degrees_of_freedom, freedom, ratio) >= FALSE_ALARM)
    return Check("straight line enough", straight, {"line": line.residual_std, "curves": curved})
