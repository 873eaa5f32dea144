"""Circles as plain shapes: where a deviation is drawn, which way the arrows go, and that written values do not overlap."""

import numpy as np
import pytest

from elastogeo.report.drawing.magnified import scale_for
from elastogeo.report.drawing.plots import Circle, Line, Text
from elastogeo.report.drawing.polar import Frame, direction_arrow, ring_shapes, trace_line

ANGLE = np.linspace(0, 2 * np.pi, 361)[:-1]


def frame_of(deviation: np.ndarray, size: float = 400.0) -> Frame:
    return Frame(scale_for(deviation, 150.0), size, size)


def test_a_deviation_lies_on_its_ring() -> None:
    """A trace that is one ring outside everywhere lies on that ring, drawn as the page has it: y downwards."""
    frame = frame_of(0.01 * np.cos(ANGLE))
    step = frame.scale.division
    line = trace_line(frame, ANGLE, np.full(360, step), "blue")
    x, y = np.array(line.points).T - frame.width / 2
    np.testing.assert_allclose(np.hypot(x, y), frame.ring(step), atol=0.01)
    assert line.points[0] == pytest.approx((frame.width / 2 + frame.ring(step), frame.width / 2), abs=0.01)
    quarter = min(line.points, key=lambda point: point[1])
    assert quarter[0] == pytest.approx(frame.width / 2, abs=4.0)
    rings = [shape.radius for shape in ring_shapes(frame) if isinstance(shape, Circle)]
    assert min(abs(radius - frame.ring(step)) for radius in rings) < 1e-9


@pytest.mark.parametrize("sense", [1, -1])
def test_the_arrow_of_ccw_goes_against_the_clock(sense: int) -> None:
    frame = frame_of(0.01 * np.cos(ANGLE))
    line = next(shape for shape in direction_arrow(frame, sense) if isinstance(shape, Line))
    x, y = np.array(line.points).T - frame.width / 2
    turned = np.unwrap(np.arctan2(-y, x))
    assert np.sign(turned[-1] - turned[0]) == sense


@pytest.mark.parametrize("size", [320.0, 396.0, 800.0])
@pytest.mark.parametrize("amplitude", [0.003, 0.02, 0.11])
def test_written_values_do_not_overlap(size: float, amplitude: float) -> None:
    frame = frame_of(amplitude * np.cos(2 * ANGLE), size)
    written = [shape for shape in ring_shapes(frame, ("X", "Y")) if isinstance(shape, Text) and shape.anchor == "middle"]
    values = [text for text in written if text.text[0] in "+−0" and text.text[1:2] != "Y"]
    radii = sorted(np.hypot(text.x - size / 2, text.y - 4 - size / 2) for text in values)
    assert len(radii) >= 2
    assert min(np.diff(radii)) >= 15.0 - 0.02
    assert "0 µm" in {text.text for text in values}
