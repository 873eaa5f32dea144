"""From what was identified to what the machine will do: compliance at the tool, whether the tests support it, maps, paths.

Stands on `identification`, `formats` and all below; knows no figure.
"""

from elastogeo.prediction.compensation import compensate
from elastogeo.prediction.knowledge import Knowledge, Predicted, knowledge_of
from elastogeo.prediction.scales import TYPICAL_COMPLIANCE, TYPICAL_LEVER, compliance_scales, parameter_scales
from elastogeo.prediction.support import SUPPORTED, unsupported_share
from elastogeo.prediction.tool_compliance import ToolCompliance, collinear_stiffness_of, compliance_along, tool_compliance
from elastogeo.prediction.virtual import functionals, virtual_observations

__all__ = [
    "SUPPORTED",
    "TYPICAL_COMPLIANCE",
    "TYPICAL_LEVER",
    "Knowledge",
    "Predicted",
    "ToolCompliance",
    "collinear_stiffness_of",
    "compensate",
    "compliance_along",
    "compliance_scales",
    "functionals",
    "knowledge_of",
    "parameter_scales",
    "tool_compliance",
    "unsupported_share",
    "virtual_observations",
]
