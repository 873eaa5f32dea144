"""What the checks of a compensation say."""

from __future__ import annotations

import numpy as np

from elastogeo.errors import several
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.scales import said, said_with
from elastogeo.report.sentences import Facts, says


@says("something to compensate")
def something_to_make_good(facts: Facts, passed: bool | None) -> str:
    """Whether anything was written."""
    if passed:
        return f"The files compensate {several(facts['tables'])}."
    return "No error was found that is greater than its uncertainty and that this control compensates: there are no files."


@says("error falls for sure")
def error_falls_for_sure(facts: Facts, passed: bool | None) -> str:
    """Whether every error is smaller after, whatever it truly is."""
    parts = [
        f"{name} from {said(before, angular)} to at most {said(after, angular)}"
        for name, angular, before, after in zip(
            facts["names"], facts["angular"], facts["before"], facts["after"], strict=True
        )
    ]
    told = f"The greatest deviation falls: {', '.join(parts)}, each deviation by itself at 95 %."
    if passed:
        return told
    return (
        f"The greatest deviation of {several(facts['grown'])} may be as great after as before: it is hardly greater than "
        f"its uncertainty. Read more cycles, or a better sensor. Greatest before, and at most after: {', '.join(parts)}."
    )


@says("points close enough")
def points_close_enough(facts: Facts, passed: bool | None) -> str:
    """What lies between the points of the files."""
    left, doubt = (said(facts[name], facts["angular"]) for name in ("left", "uncertainty"))
    told = f"The {facts['points']} points of {facts['worst']} leave {left} of what was found; its uncertainty is {doubt}"
    return f"{told}." if passed else f"{told}. Choose a smaller step, if the control takes more points."


@says("sign sure")
def sign_sure(facts: Facts, passed: bool | None) -> str:
    """The one-point check."""
    angular = facts["angular"]
    factor, unit = (180 / np.pi, "°") if facts["rotary"] else (1.0, "mm")
    place = pretty(f"{significant(facts['position'] * factor, 6)} {unit}")
    before, wrong = (said(facts[name], angular) for name in ("before", "wrong"))
    after = said_with(facts["after"], facts["uncertainty"], angular)
    check = (
        f"One point shows it on the machine: {facts['name']} at {facts['axis']} = {place}, come to in {facts['direction']}, "
        f"is {before} before; after it is {after}, with a wrong sign {wrong}."
    )
    if passed:
        return f"The sign is that of the maker's public text or of a run of the control. {check}"
    return f"No public text of the maker says the sign: confirm it on the machine before anything else. {check}"


@says("determined by the tests")
def determined_by_the_tests(facts: Facts, passed: bool | None) -> str:
    """What the tests do not show."""
    if passed:
        return "All that belongs to these errors is determined by the tests."
    return (
        f"Not determined by itself, so not written: {several(facts['names'])}. `elastogeo plan` proposes the test that "
        f"determines it; a positioning test in both directions determines a backlash."
    )


@says("greater than its uncertainty")
def greater_than_its_uncertainty(facts: Facts, passed: bool | None) -> str:
    """What is too small to be written."""
    if passed:
        return "All that is determined is greater than its expanded uncertainty."
    return f"Not greater than its expanded uncertainty, so not written: {several(facts['names'])}."


@says("uncertainty known")
def uncertainty_known(facts: Facts, passed: bool | None) -> str:
    """What has no interval."""
    if passed:
        return "Everything has an uncertainty."
    return f"Nothing shows the uncertainty of {several(facts['names'])}, so it is not written: it takes two cycles or runs."


@says("within the control's means")
def within_the_controls_means(facts: Facts, passed: bool | None) -> str:
    """What the control has no table for."""
    if passed:
        return "The control has a table for everything that was found."
    return f"The control leaves {several(facts['names'])} of {several(facts['tables'])}: {'; '.join(facts['why'])}."


@says("path corrected")
def path_corrected(facts: Facts, passed: bool | None) -> str:
    """Which components of the deviation along a path are compensated."""
    if passed:
        return f"The new program makes the deviation along {', '.join(facts['components'])} of the workpiece good."
    return "Nothing of the deviation is certain and determined: the program is as it was."


@says("deviation falls for sure")
def deviation_falls_for_sure(facts: Facts, passed: bool | None) -> str:
    """Whether the deviation along the path is smaller after, whatever it truly is."""
    before, after = said(facts["before"], False), said(facts["after"], False)
    told = (
        f"The greatest deviation along one axis, at {facts['points']} points, is {before} before and at most {after} after"
    )
    return f"{told}." if passed else f"{told}: it is hardly greater than its uncertainty. More tests make it surer."


@says("asked of the tests")
def asked_of_the_tests(facts: Facts, passed: bool | None) -> str:
    """Along which axes nothing was asked."""
    if passed:
        return "The tests were asked for parameters along every axis of the workpiece."
    return f"No parameter was asked for that moves the tool along {', '.join(facts['names'])}: nothing is compensated there."
