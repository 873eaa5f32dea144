"""Maps of simulated machines: as designed or not, from circles that tell everything or only some of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from elastogeo.formats import Design
from elastogeo.identification import identify
from elastogeo.prediction import map_compliance
from studies.predictions import campaign_of, machine_of, springs_of
from studies.rates import Cell, Named

LAYOUT = "8 circles, 32 runs"
ALONG = {"X": (-250.0, 250.0, 4), "Y": (-250.0, 250.0, 4), "Z": (-250.0, 250.0, 3)}


@dataclass(frozen=True)
class Mapped:
    """A map along Y of a random machine of three axes whose joints are symmetric; noise runs along each trace.

    Attributes
    ----------
    softer : float
        Share by which every compliance is greater than by design.
    stiffness : float
        Least stiffness that is asked for, over that of the true softest place; 0 for none.
    telling : bool
        Whether the circles tell everything; if not, the first three alone.
    """

    softer: float = 0.0
    stiffness: float = 0.0
    telling: bool = True
    share = 0.25

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `map_compliance`."""
        random = np.random.default_rng(seed)
        machine = machine_of(random)
        design = springs_of(machine, random)
        truth = {name: value * (1.0 + self.softer) for name, value in design.items()}
        campaign = campaign_of(machine, True, truth, random, drawn=0.0)
        if not self.telling:
            campaign = replace(campaign, tests=dict(list(campaign.tests.items())[:3]))
        result = identify(campaign)
        true = map_compliance(result, ALONG, direction="Y", design=Design("truth", truth)).design
        worst = 1.0 / float(true.compliance.max()) if true is not None else 1.0
        least = worst * self.stiffness or None
        return map_compliance(result, ALONG, direction="Y", design=Design("design", design), least_stiffness=least)


def mapped(check: str, truth: str, sample: Mapped, short: int = 0, **wanted: float) -> Cell:
    """A cell of this sample."""
    return Cell(truth, LAYOUT, "of the run", sample, Named(check), short=short, **wanted)
