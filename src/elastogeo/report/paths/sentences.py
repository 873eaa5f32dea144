"""What the checks of a prediction along a path say."""

from __future__ import annotations

from math import degrees

from elastogeo.report.numbers import significant
from elastogeo.report.sentences import Facts, says


@says("path supported")
def path_supported(facts: Facts, _: bool | None) -> str:
    """Where the tests determine the deviation."""
    unseen = ", ".join(facts["not_asked"])
    beside = f" Nothing asked for moves the tool in {unseen}: it is not predicted there." if unseen else ""
    if facts["first"] is None:
        return f"The tests determine the deviation at all {facts['points']} points.{beside}"
    share = f"{100 * facts['supported'] / facts['points']:.0f} %"
    prior = "the values there rest on the stated prior" if facts["prior"] else "nothing is stated there"
    return (
        f"The tests determine the deviation at {share} of {facts['points']} points; at point {facts['first']} and others up "
        f"to {significant(100 * facts['unsupported'], 2)} % of what is asked no test sees: {prior}. {_remedy(facts)}{beside}"
    )


def _remedy(facts: Facts) -> str:
    """What makes more of the same tests, before others are made."""
    ways = []
    if not facts["reciprocal"]:
        ways.append("take the joints as reciprocal (across a force a bar sees only the sum of both ways)")
    if facts["datum"] == "machine":
        ways.append("take the workpiece as probed on the machine (its place and alignment then do not matter)")
    first = f"First {', or '.join(ways)}; then add" if ways else "Add"
    return f"{first} tests at such poses (`elastogeo plan`)."


@says("intervals shown")
def intervals_shown(facts: Facts, passed: bool | None) -> str:
    """Whether the runs are enough for an interval."""
    if passed:
        return "Every predicted deviation has a 95 % interval, from the scatter of the runs and all stated influences."
    return (
        f"{facts['without']} of {facts['points']} points have a value and no interval: the runs are too few to show it. "
        f"Repeat the tests."
    )


@says("faults asked for")
def faults_asked_for(facts: Facts, passed: bool | None) -> str:
    """What the prediction takes as perfect."""
    if not facts["geometry"]:
        return "No geometry was asked of the tests: the machine counts as straight, and only what a load does is predicted."
    if not passed:
        return "No compliance was asked of the tests: the machine counts as rigid, and what the load does is left out."
    rigid = facts["rigid"]
    if not rigid:
        return "Geometry and all joint compliances were asked for."
    named = ", ".join(facts["first_rigid"]) + (", ..." if rigid > len(facts["first_rigid"]) else "")
    return f"Geometry and compliance were asked for; {rigid} joint compliances were not and count as rigid ({named})."


@says("within the tests")
def within_the_tests(facts: Facts, passed: bool | None) -> str:
    """Whether the path stays where the machine was tested."""
    if passed:
        return "The path stays within the travel and the forces that were tested."
    said = [_axis(one) for one in facts["axes"]]
    if facts["force"] > facts["tested_force"]:
        said.append(f"force up to {facts['force']:.0f} N, tested up to {facts['tested_force']:.0f} N")
    return f"The path leaves what was tested ({'; '.join(said)}): the laws that were fitted are taken to hold there too."


def _axis(one: Facts) -> str:
    low, high = (degrees(end) if one["rotary"] else end for end in one["path"])
    least, most = (degrees(end) if one["rotary"] else end for end in one["tested"])
    unit = "°" if one["rotary"] else " mm"
    return f"{one['axis']} {low:.4g} to {high:.4g}{unit}, tested {least:.4g} to {most:.4g}{unit}"


@says("force with its uncertainty")
def force_uncertain(facts: Facts, passed: bool | None) -> str:
    """Whether the force is taken as exact."""
    if passed:
        return f"The force is uncertain by {100 * facts['relative']:.2g} %, which the intervals hold."
    return (
        "No uncertainty of the force is stated: the intervals hold for exactly this force. State relative_uncertainty; "
        "published cutting coefficients are good to 10 to 20 %."
    )


@says("tool counted")
def tool_counted(facts: Facts, passed: bool | None) -> str:
    """Whether tool and holder give way."""
    if not passed:
        return "Tool and holder count as rigid, which is often the softest link: describe them under [tool] of the cut file."
    uncertain = f", uncertain by {100 * facts['relative']:.2g} %" if facts["relative"] else ", taken as exact"
    return f"Tool and holder give way as well: {facts['tool']}{uncertain}."
