"""From what was identified to what the machine will do: compliance at the tool, whether the tests support it, maps, paths.

Stands on `identification`, `formats` and all below; knows no figure.
"""

from elastogeo.prediction.compensation import compensate, compensate_path
from elastogeo.prediction.knowledge import Knowledge, Predicted, knowledge_of
from elastogeo.prediction.maps import (
    Acceptance,
    AgainstDesign,
    ComplianceMap,
    DesignParameter,
    Grid,
    Place,
    accepted,
    map_compliance,
)
from elastogeo.prediction.maps.verdict import (
    DESIGN,
    FOUNDATION,
    LIMIT,
    NOTHING_LEFT_OUT,
    SUPPORTED_EVERYWHERE,
    UNCERTAINTY_KNOWN,
)
from elastogeo.prediction.paths import (
    DEVIATION_COMPONENTS,
    PARTS,
    TOOL,
    PartOfDeviation,
    PathPrediction,
    Piece,
    PieceDeviation,
    deviations,
    known_deviation,
    path_deviation,
    predict,
    simulated_points,
)
from elastogeo.prediction.scales import TYPICAL_COMPLIANCE, TYPICAL_LEVER, compliance_scales, parameter_scales
from elastogeo.prediction.support import SUPPORTED, unsupported_share
from elastogeo.prediction.tool_compliance import (
    ToolCompliance,
    collinear_stiffness_of,
    compliance_along,
    entry_rows,
    tool_compliance,
)
from elastogeo.prediction.virtual import functionals, virtual_observations

__all__ = [
    "DESIGN",
    "DEVIATION_COMPONENTS",
    "FOUNDATION",
    "LIMIT",
    "NOTHING_LEFT_OUT",
    "PARTS",
    "SUPPORTED",
    "SUPPORTED_EVERYWHERE",
    "TOOL",
    "TYPICAL_COMPLIANCE",
    "TYPICAL_LEVER",
    "UNCERTAINTY_KNOWN",
    "Acceptance",
    "AgainstDesign",
    "ComplianceMap",
    "DesignParameter",
    "Grid",
    "Knowledge",
    "PartOfDeviation",
    "PathPrediction",
    "Piece",
    "PieceDeviation",
    "Place",
    "Predicted",
    "ToolCompliance",
    "accepted",
    "collinear_stiffness_of",
    "compensate",
    "compensate_path",
    "compliance_along",
    "compliance_scales",
    "deviations",
    "entry_rows",
    "functionals",
    "knowledge_of",
    "known_deviation",
    "map_compliance",
    "parameter_scales",
    "path_deviation",
    "predict",
    "simulated_points",
    "tool_compliance",
    "unsupported_share",
    "virtual_observations",
]
