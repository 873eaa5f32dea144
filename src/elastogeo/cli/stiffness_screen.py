"""What a person sees of a stiffness map at the terminal. Nothing is computed here."""

from __future__ import annotations

from elastogeo.cli import screen
from elastogeo.identification import StiffnessMap
from elastogeo.report import balance_rows, level_rows, overall_name, stiffness_rows


def show_stiffness(found: StiffnessMap) -> None:
    """The drives, the map, the joints, the verdict."""
    screen.show_head(found.joints)
    drives = screen.empty_table(("axis", "motor", "value ± U (95 %)", "unit"), left=(0, 1, 3))
    for balance in balance_rows(found):
        drives.add_row(balance.axis, balance.parameter, balance.value, balance.unit)
    screen.show_table(drives)
    screen.say("")
    levels = screen.empty_table(("force [N]", "secant (6.5) [N/um]", "increment [N/um]", "modelled [N/um]"), left=())
    for level in level_rows(found):
        levels.add_row(level.force, level.secant, level.increment, level.modelled)
    screen.show_table(levels)
    screen.say("")
    screen.say(f"Stiffness by direction: {overall_name(found)}")
    by_direction = screen.empty_table(("direction [deg]", "compliance ± U [um/N]", "stiffness [N/um]", "95 %"), left=())
    for row in stiffness_rows(found):
        by_direction.add_row(row.direction, row.compliance, row.stiffness, row.stiffness_interval)
    screen.show_table(by_direction)
    screen.say("")
    screen.show_parameters(found.joints)
    screen.say("")
    for check in found.verdict:
        screen.show_check(check)
    said = {check.name for check in found.verdict}
    for check in found.joints.verdict:
        if check.name not in said:
            screen.show_check(check)
