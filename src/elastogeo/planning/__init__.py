"""Which tests to run: candidates, what they tell, the choice among them. Stands on `prediction` and all below."""

from elastogeo.planning.ceilings import Ceiling, Pair, ceiling

__all__ = ["Ceiling", "Pair", "ceiling"]
