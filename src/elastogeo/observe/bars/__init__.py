"""Instruments with two balls and a bar between them."""

from elastogeo.observe.bars.ball_bar import LoadedBallBar

__all__ = ["LoadedBallBar"]
