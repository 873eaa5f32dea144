"""What a person sees of a static test at the terminal. Nothing is computed here."""

from __future__ import annotations

from elastogeo.cli import screen
from elastogeo.identification.static_tests import StaticResults
from elastogeo.report import parameter_rows, static_tables


def show_static(found: StaticResults) -> None:
    """What the instrument shows, the joints, the verdict."""
    screen.show_head(found.joints)
    for table in static_tables(found):
        screen.say(table.title)
        shown = screen.empty_table(table.headings, left=table.words)
        for row in table.rows:
            shown.add_row(*row)
        screen.show_table(shown)
        for note in table.notes:
            screen.say(note)
        screen.say("")
    screen.say("Joints")
    screen.show_parameters(found.joints)
    for parameter in parameter_rows(found.joints):
        if parameter.stands_for != parameter.name:
            screen.say(f"{parameter.name} stands for {parameter.stands_for}")
    screen.say("")
    for check in found.verdict:
        screen.show_check(check)
