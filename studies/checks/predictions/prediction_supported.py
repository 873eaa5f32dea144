"""Whether the tests tell what is asked: by the row space, not by the readings."""

from studies.prediction_samples import Mapped, mapped
from studies.rates import Study

CHECK = "prediction supported"

STUDY = Study(
    CHECK,
    "The compliance along Y at 48 places of the volume, from eight circles at places that tell everything, and from three "
    "of them. It is arithmetic: no reading decides it.",
    (
        mapped(CHECK, "circles that tell everything", Mapped(), short=1, most=0.0),
        mapped(CHECK, "three of them", Mapped(telling=False), short=1, least=1.0),
    ),
    order=2,
)
