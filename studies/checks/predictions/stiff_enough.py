"""Acceptance against a limit by ISO 14253-1: an alarm says that a place does not conform, or that one is not decided."""

from studies.prediction_samples import Mapped, mapped
from studies.rates import Study

CHECK = "stiff enough"

STUDY = Study(
    CHECK,
    "Random machines of three axes, the compliance along Y at 48 places, against a limit on the stiffness. An alarm is a "
    "place that does not conform; where one is not decided and none fails, it counts as not tested. The truth is that of "
    "the softest place: just at the limit it may be accepted or refused, each by mistake.",
    (
        mapped(CHECK, "10 % stiffer than the limit", Mapped(stiffness=0.9), short=1, most=0.01),
        mapped(CHECK, "just at the limit", Mapped(stiffness=1.0), most=0.05),
        mapped(CHECK, "20 % softer than the limit", Mapped(stiffness=1.25), short=1, least=0.9),
    ),
    order=2,
)
