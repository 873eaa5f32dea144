"""The rule tried out on simulated machines, and on tests that were recorded."""

from elastogeo.changes.trials.result import FaultFound, RuleTest
from elastogeo.changes.trials.trying import try_rule

__all__ = ["FaultFound", "RuleTest", "try_rule"]
