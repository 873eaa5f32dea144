"""Which tests to run: candidates, what they tell, the choice among them. Stands on `prediction` and all below."""

from elastogeo.planning.ceilings import Ceiling, Pair, ceiling
from elastogeo.planning.families import BAR, PROBES, SIX, FamilyCeiling, family_ceiling, family_of

__all__ = ["BAR", "PROBES", "SIX", "Ceiling", "FamilyCeiling", "Pair", "ceiling", "family_ceiling", "family_of"]
