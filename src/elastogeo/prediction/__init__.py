"""From what was identified to what the machine will do: compliance at the tool, whether the tests support it, maps, paths.

Stands on `identification`, `formats` and all below; knows no figure.
"""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.prediction.compensation import compensate, compensate_path
    from elastogeo.prediction.knowledge import Knowledge, Predicted, Span, knowledge_of
    from elastogeo.prediction.maps import (
        COVARIANCES,
        Acceptance,
        AgainstDesign,
        ComplianceMap,
        DesignParameter,
        ElementMap,
        Elements,
        Grid,
        MapSection,
        Place,
        Spot,
        accepted,
        map_compliance,
        map_elements,
        section_of,
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
    from elastogeo.prediction.scales import TYPICAL_COMPLIANCE, TYPICAL_LEVER, parameter_scales
    from elastogeo.prediction.support import SUPPORTED, unsupported_share
    from elastogeo.prediction.tool_compliances import (
        ToolCompliance,
        collinear_stiffness_of,
        compliance_along,
        entry_rows,
        tool_compliance,
    )
    from elastogeo.prediction.virtual import functionals, virtual_observations

__all__ = [
    "COVARIANCES",
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
    "ElementMap",
    "Elements",
    "Grid",
    "Knowledge",
    "MapSection",
    "PartOfDeviation",
    "PathPrediction",
    "Piece",
    "PieceDeviation",
    "Place",
    "Predicted",
    "Span",
    "Spot",
    "ToolCompliance",
    "accepted",
    "collinear_stiffness_of",
    "compensate",
    "compensate_path",
    "compliance_along",
    "deviations",
    "entry_rows",
    "functionals",
    "knowledge_of",
    "known_deviation",
    "map_compliance",
    "map_elements",
    "parameter_scales",
    "path_deviation",
    "predict",
    "section_of",
    "simulated_points",
    "tool_compliance",
    "unsupported_share",
    "virtual_observations",
]

__getattr__ = first_use(
    __name__,
    {
        "compensation": "compensate compensate_path",
        "knowledge": "Knowledge Predicted Span knowledge_of",
        "maps": "Acceptance AgainstDesign COVARIANCES ComplianceMap DesignParameter ElementMap Elements Grid MapSection "
        "Place Spot accepted map_compliance map_elements section_of",
        "maps.verdict": "DESIGN FOUNDATION LIMIT NOTHING_LEFT_OUT SUPPORTED_EVERYWHERE UNCERTAINTY_KNOWN",
        "paths": "DEVIATION_COMPONENTS PARTS PartOfDeviation PathPrediction Piece PieceDeviation "
        "TOOL deviations known_deviation path_deviation predict simulated_points",
        "scales": "TYPICAL_COMPLIANCE TYPICAL_LEVER parameter_scales",
        "support": "SUPPORTED unsupported_share",
        "tool_compliances": "ToolCompliance collinear_stiffness_of compliance_along entry_rows tool_compliance",
        "virtual": "functionals virtual_observations",
    },
)
