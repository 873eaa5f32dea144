"""The shortcut of the physics study says what a whole identification says."""

from __future__ import annotations

import pytest

from elastogeo.identification import identify
from studies.bar_tests import make_test
from studies.checks.physically_consistent import BOUNDARY, PLANAR, Judged, coupled
from studies.truth import Truth


@pytest.mark.parametrize(("truth", "noise"), [(BOUNDARY, "white"), (coupled(0.1), "of the run")])
def test_the_shortcut_is_the_identification(truth: Truth, noise: str) -> None:
    judged = Judged("7 runs", noise, truth, PLANAR).draw((3,))
    whole = identify(make_test("7 runs", truth, noise, (3,), question=PLANAR)).consistency
    assert whole is not None
    assert (judged.state, judged.why) == (whole.state, whole.why)
    assert judged.p_value == pytest.approx(whole.p_value)
    assert judged.distance == pytest.approx(whole.distance)
