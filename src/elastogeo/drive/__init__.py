"""Feed drives: motor current -> torque -> force at the joint -> at the tool. Stands on `machine`, `estimate`, `errors`."""

from elastogeo.drive.agreement import Delay, ForceAgreement, ForceRecord, compare_forces, find_delay
from elastogeo.drive.balance import BalanceFit, TorqueBalance, identify_balance
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
    known_terms,
    known_torque_balance,
    motor_parameters,
)
from elastogeo.drive.model import TorqueModel, motion_columns
from elastogeo.drive.records import DriveRecord
from elastogeo.drive.search import search_balance
from elastogeo.drive.series import (
    RigCheck,
    SetupCompliance,
    compliance_from_stiffness,
    engagement_from_force,
    force_from_engagement,
    in_series,
    in_series_uncertainty,
    inverse_uncertainty,
    machine_compliance,
    machine_compliance_uncertainty,
    rig_check,
    setup_compliance,
    stiffness_from_compliance,
    with_rig,
)
from elastogeo.drive.servo import (
    FEEDBACKS,
    ServoLoop,
    ServoStiffness,
    complex_stiffness,
    poles,
    servo_stiffness,
    static_stiffness,
)
from elastogeo.drive.trial import DriveTest
from elastogeo.drive.validation import leave_one_run_out, predict, structure
from elastogeo.drive.virtual_work import joint_forces, tool_force

__all__ = [
    "FEEDBACKS",
    "BalanceFit",
    "Delay",
    "Derivatives",
    "DriveRecord",
    "DriveTest",
    "FeedDrive",
    "ForceAgreement",
    "ForceRecord",
    "KnownBalance",
    "MotorParameter",
    "RigCheck",
    "ServoLoop",
    "ServoStiffness",
    "SetupCompliance",
    "TorqueBalance",
    "TorqueModel",
    "balance_effort",
    "compare_forces",
    "complex_stiffness",
    "compliance_from_stiffness",
    "current_from_effort",
    "differentiate",
    "effort_from_current",
    "effort_from_force",
    "engagement_from_force",
    "find_delay",
    "force_from_effort",
    "force_from_engagement",
    "gain",
    "identify_balance",
    "in_series",
    "in_series_uncertainty",
    "inverse_uncertainty",
    "joint_forces",
    "known_terms",
    "known_torque_balance",
    "leave_one_run_out",
    "machine_compliance",
    "machine_compliance_uncertainty",
    "motion_columns",
    "motor_parameters",
    "poles",
    "predict",
    "rig_check",
    "search_balance",
    "servo_stiffness",
    "setup_compliance",
    "smoothed",
    "static_stiffness",
    "stiffness_from_compliance",
    "structure",
    "tool_force",
    "with_rig",
]
