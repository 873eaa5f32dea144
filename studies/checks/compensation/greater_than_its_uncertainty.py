"""What of an error is written: a reversal that is there, and none that is not."""

from studies.compensation_samples import compensated
from studies.rates import Study

CHECK = "greater than its uncertainty"

STUDY = Study(
    CHECK,
    "A part of an error is left out, and the check says so, where its root mean square over the targets is not greater than "
    "that of its expanded uncertainty. With white noise of 0.4 um the U of half a reversal is 0.37 um, root mean square; "
    "cycles whose zero and slope wander change nothing of it.",
    (
        *compensated(CHECK, "no reversal", 0.0, short=8, least=0.95),
        *compensated(CHECK, "a reversal of 0.8 um, which is about its U", 8e-4),
        *compensated(CHECK, "a reversal of 3 um", 3e-3, short=8, most=0.05),
    ),
    order=2,
)
