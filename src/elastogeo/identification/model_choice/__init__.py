"""Which model the data support: the one that was asked, or one richer in geometry, compliance, force or set-up.

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.model_choice.candidates import COMPLIANCE, FORCE, GEOMETRY, SET_UP, Offer
from elastogeo.identification.model_choice.choice import compare_models
from elastogeo.identification.model_choice.following import OffLevel
from elastogeo.identification.model_choice.result import Candidate, ModelChoice

__all__ = ["COMPLIANCE", "FORCE", "GEOMETRY", "SET_UP", "Candidate", "ModelChoice", "OffLevel", "Offer", "compare_models"]
