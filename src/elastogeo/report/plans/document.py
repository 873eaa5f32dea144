"""`elastogeo.plan/1`: which tests to run, and what they will tell.

machine : {name, topology}
goal, asked, candidates, proposed, minutes : what the plan is for, the parameters that were named, how many tests it was
    chosen from, instruments whose tests were added since those offered do not tell what was asked
forces_N, tools_mm : force levels of every test, tool points
noise : {reading_mm, angle_rad, set_up_mm, force}: standard deviations that the tests were taken to be read with
made : names of the tests that were made already
tests : [{name, instrument, minutes, commands, rank, supported, worst_with_prior}], in the order of doing; `commands` by axis
    [mm, rad], least and greatest; the last three after this test
parameters : [{name, unit, known, stands_for, standard_uncertainty, scale}]; known is `alone`, `sum` or `unseen`
rank, highest_rank, weak : directions determined, determined by any such tests, and known worse than expected
fewest : how many tests support the whole workspace, or null
never_alone : [{name, alike, probes: [{across, sensor, point_mm}]}], of the asked ones those that no test between tool and
    workpiece tells by itself; `alike` make the same trace, `probes` would tell it
workspace : [{tool_mm, share, median, worst, worst_with_prior, worst_at, tests_needed, more_needed}], standard
    uncertainties in mm/N; how many tests support all of it at least, and how many it takes beside the plan
next_best : {name, rank, worst_with_prior, supported} or null
verdict : as in `envelope`
"""

from __future__ import annotations

from typing import Any

from elastogeo.planning import Candidate, Expectation, NextBest, Plan, PlannedTest, Reason, ToolSupport
from elastogeo.report.document import document, verdict_entries

PLAN_SCHEMA = "elastogeo.plan/1"


def plan_json(plan: Plan) -> dict[str, Any]:
    """A plan as one JSON object (`elastogeo.plan/1`)."""
    machine, noise = plan.means.machine, plan.noise
    return document(
        PLAN_SCHEMA,
        {
            "machine": {"name": machine.name, "topology": machine.topology.compact},
            "goal": plan.goal,
            "asked": plan.asked,
            "candidates": plan.candidates,
            "proposed": plan.proposed,
            "minutes": plan.minutes,
            "forces_N": plan.means.forces,
            "tools_mm": plan.means.tool_points,
            "noise": {
                "reading_mm": noise.reading,
                "angle_rad": noise.angle,
                "set_up_mm": noise.set_up,
                "force": noise.force,
            },
            "made": [] if plan.made is None else list(plan.made.tests),
            "tests": [_test(one) for one in plan.tests],
            "parameters": [_parameter(p) for p in plan.parameters],
            "rank": plan.rank,
            "highest_rank": plan.highest_rank,
            "weak": plan.weak,
            "fewest": plan.fewest,
            "never_alone": [_never_alone(why) for why in plan.reasons],
            "workspace": [_support(tool) for tool in plan.tools],
            "next_best": None if plan.next_best is None else _next_best(plan.next_best),
            "verdict": verdict_entries(plan.verdict),
        },
    )


def _test(one: PlannedTest) -> dict[str, Any]:
    return {
        "name": one.candidate.name,
        "instrument": one.candidate.test.instrument,
        "minutes": one.candidate.minutes,
        "commands": commands_of(one.candidate),
        "rank": one.rank_so_far,
        "supported": one.supported_so_far,
        "worst_with_prior": one.worst_so_far,
    }


def _parameter(p: Expectation) -> dict[str, Any]:
    return {
        "name": p.name,
        "unit": p.unit,
        "known": p.known,
        "stands_for": dict(p.stands_for),
        "standard_uncertainty": p.standard_uncertainty,
        "scale": p.scale,
    }


def _never_alone(why: Reason) -> dict[str, Any]:
    probes = () if why.remedy is None else why.remedy.probes
    return {
        "name": why.name,
        "alike": why.alike,
        "probes": [{"across": p.across, "sensor": p.sensor, "point_mm": p.point} for p in probes],
    }


def _support(tool: ToolSupport) -> dict[str, Any]:
    return {
        "tool_mm": tool.tool,
        "share": tool.share,
        "median": tool.median,
        "worst": tool.worst,
        "worst_with_prior": tool.worst_with_prior,
        "worst_at": dict(tool.worst_at),
        "tests_needed": tool.tests_needed,
        "more_needed": tool.more_needed,
    }


def _next_best(more: NextBest) -> dict[str, Any]:
    return {
        "name": more.candidate.name,
        "rank": more.rank,
        "worst_with_prior": more.worst,
        "supported": more.supported,
    }


def commands_of(candidate: Candidate) -> dict[str, list[float]]:
    """Least and greatest command of each axis [mm, rad]."""
    commands = candidate.test.observations()[0].commands
    axes = candidate.test.machine.axes
    return {axis: [float(commands[:, k].min()), float(commands[:, k].max())] for k, axis in enumerate(axes)}
