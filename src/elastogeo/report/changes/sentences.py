"""What the checks of a series of tests say."""

from __future__ import annotations

from elastogeo.report.changes.words import shown_unit, title_of
from elastogeo.report.numbers import significant
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import listed


@says("machine unchanged")
def machine_unchanged(facts: Facts, passed: bool | None) -> str:
    """Whether there is an alarm."""
    tests = f"{facts['tests']} {'test' if facts['tests'] == 1 else 'tests'}"
    if passed:
        return f"{tests} since the baseline {'stays' if facts['tests'] == 1 else 'stay'} within their limits."
    if passed is None:
        if facts["state"] == "suspect":
            return "The last test is suspect: only its repeat tells."
        return "Without a baseline that is long enough, and a test after it, nothing can be said."
    changed = title_of(listed(facts["changed"]))
    return f"{changed} changed by more than tests of this machine scatter, and by enough to matter."


@says("change confirmed")
def change_confirmed(_: Facts, passed: bool | None) -> str:
    """Whether a second test shows it."""
    return (
        "A second test shows the change as well."
        if passed
        else "No second test confirms the change: the suspect test was not repeated in time. Repeat it."
    )


@says("change explained by one component")
def change_explained(facts: Facts, passed: bool | None) -> str:
    """Whether a single fault makes such a set of changes."""
    if passed:
        first, *others = facts["components"]
        return f"The changes fit a fault of one component: {first}{f'; or {listed(others)}' if others else ''}."
    if passed is None:
        return "How faults of components move the indicators of this test is not known, so none is named."
    why = "there are several faults, or one that is not in the model"
    if facts["left"]:
        return f"A fault of one component ({facts['components'][0]}) leaves {listed(facts['left'])} unexplained: {why}."
    return f"No single component explains the changes: {why}."


@says("within tolerance")
def within_tolerance(facts: Facts, passed: bool | None) -> str:
    """Whether what a person wants holds."""
    rest = f" No test since the baseline determines {listed(facts['unknown'])}." if facts["unknown"] else ""
    if passed:
        return f"{title_of(listed(facts['asked']))} {'lies' if len(facts['asked']) == 1 else 'lie'} within tolerance.{rest}"
    if passed is None:
        return "No test since the baseline says where the machine stands in its tolerance."
    said = []
    for name, value in facts["beyond"].items():
        unit = shown_unit(facts["units"][name])
        said.append(f"{name} ({significant(value * unit.factor)} {unit.name})")
    return f"Out of tolerance: {listed(said)}.{rest}"


@says("baseline long enough")
def baseline_long_enough(facts: Facts, passed: bool | None) -> str:
    """Whether it says how the tests scatter."""
    if passed:
        return f"The baseline is made of {facts['tests']} tests."
    tests = f"{facts['tests']} {'test' if facts['tests'] == 1 else 'tests'}"
    if facts["watched"]:
        names = listed(facts["watched"])
        return (
            f"The baseline has {tests} of {names}: {facts['least']} are needed before a test can be suspect. Until then "
            f"{names} {'is' if len(facts['watched']) == 1 else 'are'} only watched."
        )
    return (
        f"The baseline is made of {tests}: {facts['least']} are needed before a test can be suspect. Until "
        f"then the machine is only watched."
    )


@says("baseline steady")
def baseline_steady(facts: Facts, passed: bool | None) -> str:
    """Whether nothing changed while it was made."""
    if passed:
        return "Nothing drifted while the baseline was made."
    if passed is None:
        return "The baseline is too short to show a drift."
    return (
        f"{title_of(listed(facts['trends']))} drifted while the baseline was made: what it calls ordinary was on its way "
        f"somewhere. Set another baseline."
    )


@says("scatter as expected")
def scatter_as_expected(facts: Facts, passed: bool | None) -> str:
    """Whether the tests of the baseline repeat as well as such tests do."""
    if passed:
        return "The tests of the baseline scatter no more than such tests do."
    if passed is None:
        return "The baseline is too short to show its scatter."
    said = []
    for name, (own, expected) in facts["beyond"].items():
        said.append(f"{name} by {significant(own / expected, 2)} times as much")
    return (
        f"The tests of the baseline scatter more than such tests do: {listed(said)}. Small changes stay unseen; look at how "
        f"the balls sit and how the machine is warmed up."
    )


@says("temperature known")
def temperature_known(facts: Facts, passed: bool | None) -> str:
    """Whether a season can be told from a change."""
    if passed:
        names = facts["corrected"]
        corrected = f" {title_of(listed(names))} {'is' if len(names) == 1 else 'are'} corrected for it." if names else ""
        return f"Every test says how warm the machine was.{corrected}"
    if passed is None:
        return "There is no test yet."
    return (
        f"{facts['without']} of {facts['tests']} tests do not say how warm the machine was, so a season may look like a "
        f"change. Write the temperature into the tests."
    )


@says("tests independent")
def tests_independent(facts: Facts, passed: bool | None) -> str:
    """Whether each test is news."""
    share = f"correlation of successive tests {significant(facts['correlation'], 2)}"
    if passed:
        return f"Successive tests scatter independently ({share})."
    if passed is None:
        return "The tests are too few to tell whether they depend on one another."
    return (
        f"Successive tests are alike ({share}, over {facts['pairs']} pairs): the running mean makes more false alarms than "
        f"it is designed for. Temperature or the set-up may be why."
    )


@says("the same again")
def the_same_again(facts: Facts, passed: bool | None) -> str:
    """Whether the raw records give again what is kept."""
    if passed is None:
        return "Nothing was compared: this version computed these tests for the first time."
    if passed:
        bits = facts["same_bits"]
        return f"{bits} of {facts['compared']} tests are the same to the last bit, the others to 1e-12 of each number."
    return (
        f"{facts['differing']} of {facts['compared']} tests differ, first {facts['first']!r} at {facts['path']}: "
        "the program, or what it stands on, is another one under the same version number."
    )


@says("within the scatter")
def within_the_scatter(facts: Facts, passed: bool | None) -> str:
    """Whether two tests differ by no more than those of an unchanged machine."""
    count = facts["judged"]
    if passed:
        return f"All {count} indicators differ by no more than two tests of the unchanged machine do."
    names = title_of(listed(name for name, _, _ in facts["beyond"]))
    return f"{names} differ{'s' if len(facts['beyond']) == 1 else ''} by more than two tests of the unchanged machine do."
