"""Feed drives: motor current -> torque -> force at the joint -> at the tool. Stands on `machine`, `estimate`, `errors`."""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.drive.balance import BalanceFit, Searched, TorqueBalance, free_labels, identify_balance, units_of
    from elastogeo.drive.differentiator import Derivatives, differentiate, gain, smoothed
    from elastogeo.drive.dwells import Standstill, standing, standstill, window_of
    from elastogeo.drive.feed_drive import (
        FeedDrive,
        current_from_effort,
        effort_from_current,
        effort_from_force,
        force_from_effort,
    )
    from elastogeo.drive.force_agreement import Delay, ForceAgreement, ForceRecord, SharedError, compare_forces, find_delay
    from elastogeo.drive.known_balance import (
        KnownBalance,
        MotorParameter,
        balance_effort,
        known_terms,
        known_torque_balance,
        motor_parameters,
    )
    from elastogeo.drive.measurement import EVERY_LOG, DriveTest
    from elastogeo.drive.model import PLAIN, Mask, TorqueModel, motion_columns, usable
    from elastogeo.drive.nonlinear import SEARCHABLE, make_search, ranges_of, search_balance, shared_masks
    from elastogeo.drive.records import DriveRecord
    from elastogeo.drive.series import (
        RigCheck,
        SetupCompliance,
        rig_check,
        setup_compliance,
        with_rig,
    )
    from elastogeo.drive.terms import Motion
    from elastogeo.drive.validation import LeftOut, RunScore, Structure, leave_one_run_out, predict, structure
    from elastogeo.drive.virtual_work import joint_forces, tool_force

__all__ = [
    "EVERY_LOG",
    "PLAIN",
    "SEARCHABLE",
    "BalanceFit",
    "Delay",
    "Derivatives",
    "DriveRecord",
    "DriveTest",
    "FeedDrive",
    "ForceAgreement",
    "ForceRecord",
    "KnownBalance",
    "LeftOut",
    "Mask",
    "Motion",
    "MotorParameter",
    "RigCheck",
    "RunScore",
    "Searched",
    "SetupCompliance",
    "SharedError",
    "Standstill",
    "Structure",
    "TorqueBalance",
    "TorqueModel",
    "balance_effort",
    "compare_forces",
    "current_from_effort",
    "differentiate",
    "effort_from_current",
    "effort_from_force",
    "find_delay",
    "force_from_effort",
    "free_labels",
    "gain",
    "identify_balance",
    "joint_forces",
    "known_terms",
    "known_torque_balance",
    "leave_one_run_out",
    "make_search",
    "motion_columns",
    "motor_parameters",
    "predict",
    "ranges_of",
    "rig_check",
    "search_balance",
    "setup_compliance",
    "shared_masks",
    "smoothed",
    "standing",
    "standstill",
    "structure",
    "tool_force",
    "units_of",
    "usable",
    "window_of",
    "with_rig",
]

__getattr__ = first_use(
    __name__,
    {
        "balance": "BalanceFit Searched TorqueBalance free_labels identify_balance units_of",
        "differentiator": "Derivatives differentiate gain smoothed",
        "feed_drive": "FeedDrive current_from_effort effort_from_current effort_from_force force_from_effort",
        "force_agreement": "Delay ForceAgreement ForceRecord SharedError compare_forces find_delay",
        "known_balance": "KnownBalance MotorParameter balance_effort known_terms known_torque_balance motor_parameters",
        "measurement": "DriveTest EVERY_LOG",
        "model": "Mask PLAIN TorqueModel motion_columns usable",
        "nonlinear": "SEARCHABLE make_search ranges_of search_balance shared_masks",
        "records": "DriveRecord",
        "series": "RigCheck SetupCompliance rig_check setup_compliance with_rig",
        "dwells": "Standstill standing standstill window_of",
        "terms": "Motion",
        "validation": "LeftOut RunScore Structure leave_one_run_out predict structure",
        "virtual_work": "joint_forces tool_force",
    },
)
