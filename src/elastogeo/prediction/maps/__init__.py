"""Maps of the compliance at the tool over the volume. Stands on the files of `prediction` and the rooms below it."""

from elastogeo.prediction.maps.acceptance import Acceptance, accepted
from elastogeo.prediction.maps.compliance_map import map_compliance
from elastogeo.prediction.maps.design import AgainstDesign, DesignParameter
from elastogeo.prediction.maps.elements import COVARIANCES, ElementMap, Elements, map_elements
from elastogeo.prediction.maps.places import Grid
from elastogeo.prediction.maps.result import ComplianceMap, Place
from elastogeo.prediction.maps.sections import MapSection, Spot, section_of

__all__ = [
    "COVARIANCES",
    "Acceptance",
    "AgainstDesign",
    "ComplianceMap",
    "DesignParameter",
    "ElementMap",
    "Elements",
    "Grid",
    "MapSection",
    "Place",
    "Spot",
    "accepted",
    "map_compliance",
    "map_elements",
    "section_of",
]
