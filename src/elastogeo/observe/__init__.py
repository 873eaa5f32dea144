"""Instruments and tests, made into a table of observations. Stands on `drive`, `machine`, `estimate` and `errors`."""

from elastogeo.observe.bars.ball_bar import LoadedBallBar
from elastogeo.observe.bars.unloaded import BallBar
from elastogeo.observe.campaign import Askable, Campaign, campaign_of, short_name, with_questions
from elastogeo.observe.circle import PLANES, Circle, plane_directions
from elastogeo.observe.contradictions import check_runs, turning
from elastogeo.observe.covariance import ASSUMED
from elastogeo.observe.expansion import Expansion
from elastogeo.observe.families import BAR, PROBES, SIX, family_of
from elastogeo.observe.force import THESIS_CALIBRATION, Calibration, ForceInfluence, force_from_pressure
from elastogeo.observe.imperfection import Imperfection, Residue
from elastogeo.observe.instruments import instrument, instrument_named, instruments
from elastogeo.observe.measurement import KnownInfluence, MachineTest, Question
from elastogeo.observe.nests import BallMotion, SphereNest
from elastogeo.observe.observations import Observations, ObservedInfluence, check_observations
from elastogeo.observe.positioning import Approaches, Positioning, approaches, distinct
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.rollers.ball_roller import BallRoller, Pressed
from elastogeo.observe.rollers.force import LOSSES
from elastogeo.observe.rollers.rig import Rig
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup, SetupFact
from elastogeo.observe.static_loads.joint_probe import JointProbe
from elastogeo.observe.static_loads.probes import DisplacementProbes
from elastogeo.observe.static_loads.sensor_frame import Sensor, SensorFrame, sensitivities
from elastogeo.observe.static_loads.sensor_twist import SensorTwist, check_sees_twist, sensor_twist
from elastogeo.observe.static_loads.static_force import StaticForce
from elastogeo.observe.template import Template

__all__ = [
    "ASSUMED",
    "BAR",
    "LOSSES",
    "PLANES",
    "PROBES",
    "SIX",
    "THESIS_CALIBRATION",
    "Approaches",
    "Askable",
    "BallBar",
    "BallMotion",
    "BallRoller",
    "Calibration",
    "Campaign",
    "Circle",
    "DisplacementProbes",
    "Expansion",
    "ForceInfluence",
    "Imperfection",
    "JointProbe",
    "KnownInfluence",
    "LoadedBallBar",
    "MachineTest",
    "Observations",
    "ObservedInfluence",
    "Positioning",
    "Pressed",
    "Procedure",
    "Question",
    "Residue",
    "Respond",
    "Rig",
    "Run",
    "Sensor",
    "SensorFrame",
    "SensorTwist",
    "Setup",
    "SetupFact",
    "SphereNest",
    "StaticForce",
    "Template",
    "approaches",
    "campaign_of",
    "check_observations",
    "check_runs",
    "check_sees_twist",
    "distinct",
    "family_of",
    "force_from_pressure",
    "instrument",
    "instrument_named",
    "instruments",
    "plane_directions",
    "sensitivities",
    "sensor_twist",
    "short_name",
    "turning",
    "with_questions",
]
