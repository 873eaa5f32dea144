"""A fleet to look at: three years of tests of seven machines, every one of them simulated and marked so.

`stories` says what is true of each machine on each day, `folders` writes a test of it as an instrument would, `living` lives
through the years with a history: tests come in, a baseline is set, a suspect test is repeated, events are noted.
"""

from elastogeo.history.fleets.living import Lived, live
from elastogeo.history.fleets.stories import FLEET, Fault, Story

__all__ = ["FLEET", "Fault", "Lived", "Story", "live"]
