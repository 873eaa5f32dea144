"""How often the intervals of the values of ISO 230-2 hold the truth: `python -m studies.positioning_values`.

Nine targets, five cycles, both directions; a curve of 20 um, a reversal of 3 um and white scatter, of which the true values
follow. No influence is stated, so that the intervals are of the scatter alone.
"""

from __future__ import annotations

import numpy as np

from elastogeo.identification import ByTarget, standard_values
from elastogeo.identification.positioning.uncertainty import with_uncertainty
from studies.positioning_samples import TARGETS

CURVE, REVERSAL = 0.010, 0.003
SCATTERS = (4e-4, 2e-3)


def counts(scatter: float, trials: int) -> dict[str, tuple[float, float, float]]:
    """By value: share of intervals that hold the truth, the truth [mm], mean difference from it [mm]."""
    means = np.column_stack([CURVE * np.sin(TARGETS / 130) + 2.5e-5 * TARGETS - side * REVERSAL / 2 for side in (1, -1)])
    truth = standard_values(ByTarget(TARGETS, np.full((9, 2), 5.0), means, np.full((9, 2), scatter)))
    target = np.tile(np.concatenate([TARGETS, TARGETS]), 5)
    sense = np.tile(np.repeat([1.0, -1.0], 9), 5)
    mean = np.tile(means.T.ravel(), 5)
    held, off = dict.fromkeys(truth, 0), dict.fromkeys(truth, 0.0)
    for seed in range(trials):
        reading = mean + scatter * np.random.default_rng(seed).standard_normal(len(mean))
        for name, value in with_uncertainty(target, sense, reading, ()).items():
            low, high = value.estimate.interval() if value.estimate else (np.nan, np.nan)
            held[name] += bool(low <= truth[name] <= high)
            off[name] += (value.value - truth[name]) / trials
    return {name: (held[name] / trials, truth[name], off[name]) for name in truth}


def main(trials: int = 200) -> None:
    """Print the counts."""
    for scatter in SCATTERS:
        print(f"scatter {1000 * scatter:g} um, {trials} tests")
        for name, (held, true, off) in counts(scatter, trials).items():
            print(f"  {name:7s} {100 * held:5.1f} %   truth {1000 * true:6.2f} um, mean difference {1000 * off:5.2f} um")


if __name__ == "__main__":
    main()
