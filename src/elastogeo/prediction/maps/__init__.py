"""Maps of the compliance at the tool over the volume. Stands on the files of `prediction` and the rooms below it."""

from elastogeo.prediction.maps.acceptance import Acceptance, accepted
from elastogeo.prediction.maps.compliance_map import map_compliance
from elastogeo.prediction.maps.design import AgainstDesign, DesignParameter
from elastogeo.prediction.maps.places import Grid
from elastogeo.prediction.maps.result import ComplianceMap, Place

__all__ = ["Acceptance", "AgainstDesign", "ComplianceMap", "DesignParameter", "Grid", "Place", "accepted", "map_compliance"]
