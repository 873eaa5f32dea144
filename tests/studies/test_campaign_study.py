"""The study of campaigns, a few trials of it: the intervals hold the truth about as often as they say."""

import numpy as np

from studies.campaigns import TOPOLOGIES, blank, trial


def test_intervals_of_random_campaigns_cover() -> None:
    held, every = np.array([trial(blank(TOPOLOGIES[k % 3], k), k) for k in range(9)]).sum(axis=0)
    # parameters of one campaign share its runs: nine campaigns of 26 count as some sixty independent intervals
    assert every > 200
    assert 0.88 <= held / every <= 1.0
    assert held < every
