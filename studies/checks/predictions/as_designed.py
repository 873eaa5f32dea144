"""A map against a design: all places together, by the surest difference."""

from studies.prediction_samples import Mapped, mapped
from studies.rates import Study

CHECK = "as designed"

STUDY = Study(
    CHECK,
    "Random machines of three axes, the compliance along Y at 48 places. Nominally 5 % over all places (Bonferroni), which "
    "makes it cautious; the gauge of 1 % is off in all alike.",
    (
        mapped(CHECK, "as designed", Mapped(), short=2, most=0.05),
        mapped(CHECK, "every compliance 20 % greater", Mapped(softer=0.2), short=1, least=0.9),
    ),
    order=2,
)
