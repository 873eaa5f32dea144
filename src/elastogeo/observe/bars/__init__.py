"""Instruments with two balls and a bar between them."""

from elastogeo.observe.bars.ball_bar import LoadedBallBar
from elastogeo.observe.bars.unloaded import BallBar

__all__ = ["BallBar", "LoadedBallBar"]
