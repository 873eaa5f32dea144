"""Feed drives: motor current -> torque -> force at the joint -> at the tool. Stands on `machine`, `estimate`, `errors`."""

from elastogeo.drive.agreement import ForceAgreement, ForceRecord, compare_forces
from elastogeo.drive.balance import BalanceFit, TorqueBalance, TorqueModel, identify_balance, motion_columns
from elastogeo.drive.differentiator import Derivatives, differentiate, gain, smoothed
from elastogeo.drive.feed_drive import (
    FeedDrive,
    current_from_effort,
    effort_from_current,
    effort_from_force,
    force_from_effort,
)
from elastogeo.drive.known_balance import (
    KnownBalance,
    MotorParameter,
    balance_effort,
    known_torque_balance,
    motor_parameters,
)
from elastogeo.drive.records import DriveRecord
from elastogeo.drive.series import RigCheck, SetupCompliance, rig_check, setup_compliance, with_rig
from elastogeo.drive.virtual_work import joint_forces, tool_force

__all__ = [
    "BalanceFit",
    "Derivatives",
    "DriveRecord",
    "FeedDrive",
    "ForceAgreement",
    "ForceRecord",
    "KnownBalance",
    "MotorParameter",
    "RigCheck",
    "SetupCompliance",
    "TorqueBalance",
    "TorqueModel",
    "balance_effort",
    "compare_forces",
    "current_from_effort",
    "differentiate",
    "effort_from_current",
    "effort_from_force",
    "force_from_effort",
    "gain",
    "identify_balance",
    "joint_forces",
    "known_torque_balance",
    "motion_columns",
    "motor_parameters",
    "rig_check",
    "setup_compliance",
    "smoothed",
    "tool_force",
    "with_rig",
]
