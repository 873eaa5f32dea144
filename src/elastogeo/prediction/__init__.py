"""From what was identified to what the machine will do: compliance at the tool, whether the tests support it, maps, paths.

Stands on `identification`, `formats` and all below; knows no figure.
"""

from elastogeo.prediction.scales import TYPICAL_COMPLIANCE, TYPICAL_LEVER, compliance_scales
from elastogeo.prediction.support import SUPPORTED, unsupported_share
from elastogeo.prediction.virtual import functionals, virtual_observations

__all__ = [
    "SUPPORTED",
    "TYPICAL_COMPLIANCE",
    "TYPICAL_LEVER",
    "compliance_scales",
    "functionals",
    "unsupported_share",
    "virtual_observations",
]
