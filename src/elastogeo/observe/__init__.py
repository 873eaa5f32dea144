"""Instruments and tests, made into a table of observations. Stands on `drive`, `machine` and `errors`."""

from elastogeo.observe.ball_bar import LoadedBallBar
from elastogeo.observe.ball_roller import BallRoller
from elastogeo.observe.circle import PLANES, Circle, plane_directions
from elastogeo.observe.force import THESIS_CALIBRATION, Calibration, force_from_pressure
from elastogeo.observe.imperfection import Imperfection, Residue
from elastogeo.observe.instruments import instrument, instrument_named, instruments
from elastogeo.observe.observations import Observations, ObservedInfluence, check_observations
from elastogeo.observe.rig import Rig
from elastogeo.observe.trial import KnownInfluence, MachineTest, Question, Run, Setup

__all__ = [
    "PLANES",
    "THESIS_CALIBRATION",
    "BallRoller",
    "Calibration",
    "Circle",
    "Imperfection",
    "KnownInfluence",
    "LoadedBallBar",
    "MachineTest",
    "Observations",
    "ObservedInfluence",
    "Question",
    "Residue",
    "Rig",
    "Run",
    "Setup",
    "check_observations",
    "force_from_pressure",
    "instrument",
    "instrument_named",
    "instruments",
    "plane_directions",
]
