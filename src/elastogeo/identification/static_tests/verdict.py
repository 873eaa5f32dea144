"""The verdict of a static test: checks of all runs gathered into one each, with their facts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.special import fdtrc

from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.identification.static_tests.by_run import Counted
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis, signed
from elastogeo.identification.static_tests.loading_curves import FEWEST_CYCLES
from elastogeo.identification.static_tests.result import Cartesian, LoadedPlace, LoadedRun, TwistPlace, TwistRun

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
    if lines := [place.line.counted for place in places if place.line is not None]:
        checks.append(counted_by_run("line", lines))
    for place in places:
        if place.drive is not None:
            name = place.drive.axis
            checks += [replace(check, name=f"drive of {name}: {check.name}") for check in place.drive.verdict]
        elif place.drive_refusal:
            checks.append(Check("drive located", None, {"why": place.drive_refusal}))
    return tuple(checks)


def probe_checks(found: Cartesian) -> tuple[Check, ...]:
    """Of displacement probes: determined, symmetric, no energy gained."""
    checks = found.compliance.checks()
    if found.compliance.undetermined:
        return checks
    zeros = Check("zeros of the probes", True, {"zeroed": found.zeroed})
    counted = counted_by_run("matrix", [found.compliance.counted])
    return (*(replace(check, decisive=check.name == "no energy gained") for check in checks), zeros, counted)


def twist_checks(runs: Sequence[TwistRun], places: Sequence[TwistPlace], refusal: str) -> tuple[Check, ...]:
    """Of a sensor frame: whether it sees the twist, whether its sensors agree, and what the uncertainties assume."""
    if not runs:
        return (Check("twist determined", False, {"why": refusal}),)
    suspects = {run.run: run.twist.suspect for run in runs if run.twist.suspect is not None}
    unchecked = tuple(k + 1 for k in range(len(runs[0].twist.redundancy)) if np.isnan(runs[0].twist.outlying[k]))
    facts = {"sensors": len(runs[0].twist.redundancy), "suspects": suspects, "unchecked": unchecked}
    agree = False if suspects else None if unchecked else True
    counted = [counted_by_run("twist", [place.counted for place in places])] if places else []
    return Check("twist determined", True, {"why": ""}), Check("sensors agree", agree, facts), *counted


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
    return signed(name, values, 1 - 2 * FALSE_ALARM / len(values))


def _by_cycle(runs: Sequence[LoadedRun]) -> Check:
    few = tuple(run.run for run in runs if run.hysteresis is not None and not run.hysteresis.by_cycle)
    cycles = sum(len(run.hysteresis.cycles) for run in runs if run.hysteresis is not None)
    return Check("uncertainty by cycle", not few, {"cycles": cycles, "few": few, "needed": FEWEST_CYCLES})


def counted_by_run(what: str, counted: Sequence[Counted]) -> Check:
    """Whether each of an instrument's own results has an uncertainty, by the scatter of its runs."""
    few = [one for one in counted if not one.by_run]
    facts = {
        "what": what,
        "runs": min((one.runs for one in few), default=max(one.runs for one in counted)),
        "needed": max((one.needed for one in few if one.needed is not None), default=None),
    }
    return Check("uncertainty of the instrument's results by run", not few, facts)


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
    straight = bool(fdtrc(line.readings - 2, freedom, ratio) >= FALSE_ALARM)
    return Check("straight line enough", straight, {"line": line.residual_std, "curves": curved})
