"""Instruments that stand still while a load comes and goes: one sensor, three probes, a frame of sensors, one at a joint."""

from elastogeo.observe.static_loads.joint_probe import JointProbe
from elastogeo.observe.static_loads.probes import DisplacementProbes
from elastogeo.observe.static_loads.sensor_frame import Sensor, SensorFrame, sensitivities
from elastogeo.observe.static_loads.sensor_twist import SensorTwist, check_sees_twist, sensor_twist
from elastogeo.observe.static_loads.static_force import StaticForce

__all__ = [
    "DisplacementProbes",
    "JointProbe",
    "Sensor",
    "SensorFrame",
    "SensorTwist",
    "StaticForce",
    "check_sees_twist",
    "sensitivities",
    "sensor_twist",
]
