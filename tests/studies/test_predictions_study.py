"""The study of predictions, a few trials of it: intervals hold the truth, and nothing is said without support."""

from __future__ import annotations

from collections import Counter

from studies.predictions import trial


def test_predictions_of_random_machines_cover() -> None:
    """Eight campaigns, each with what it shares: 95 % within what so many can tell."""
    counts: Counter[str] = sum((trial(seed) for seed in range(8)), Counter())
    data = [key.removeprefix("asked ") for key in counts if key.startswith("asked ") and "prior" not in key]
    asked, held = (sum(counts[f"{what} {kind}"] for kind in data) for what in ("asked", "held"))
    assert asked > 60
    assert 0.85 <= held / asked < 1.0
    assert counts["unsupported"] > 50
    assert counts["numbers"] == 0
    by_prior = [key.removeprefix("asked ") for key in counts if key.startswith("asked by the prior")]
    asked, held = (sum(counts[f"{what} {kind}"] for kind in by_prior) for what in ("asked", "held"))
    assert asked > 30
    assert 0.85 <= held / asked <= 1.0
