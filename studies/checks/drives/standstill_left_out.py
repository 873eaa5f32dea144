"""Whether what is at standstill was left out, and whether the intervals then hold."""

from studies.drive_samples import MISSED, Identified, Misses
from studies.dwells import TRUTH, Dwells
from studies.rates import Cell, Named, Study

RECORDS = (
    ("none", Dwells(scatter=0.005), 6),
    ("0.5 um", Dwells(noise=5e-4, scatter=0.005), 0),
    ("quantised, 1 um", Dwells(step=1e-3, scatter=0.005), 0),
)
"""Noise of the encoder in words, the records, and how many draws the tests make of them."""

CHECK = "standstill left out"

STUDY = Study(
    CHECK,
    "Moves and dwells of four runs, friction that differs by 0.5 % from run to run; at rest the drive holds any part of it. "
    "The check alarms where a stated least speed takes the rests in. Held: 95 % of the intervals of the Coulomb friction.",
    (
        *(
            Cell(
                "rests left out by default",
                "4 runs with dwells",
                noise,
                Identified(records),
                Named(CHECK),
                most=0.05,
                short=few,
            )
            for noise, records, few in RECORDS
        ),
        *(
            Cell(
                "rests left out by default: interval of the friction",
                "4 runs with dwells",
                noise,
                Identified(records),
                Misses("coulomb", TRUTH["coulomb"]),
                (MISSED,),
                most=0.05,
                short=few,
            )
            for noise, records, few in RECORDS
        ),
        *(
            Cell(
                "least speed 0: rests taken in",
                "4 runs with dwells",
                noise,
                Identified(records, least_speed=0.0),
                Named(CHECK),
                least=0.95,
                short=few,
            )
            for noise, records, few in RECORDS
        ),
    ),
    order=2,
)
