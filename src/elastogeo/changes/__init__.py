"""Has it changed? A series of tests becomes charts, limits, states and a verdict, without a database.

Stands on all rooms below, mostly on `identification` and `prediction` for what an indicator is; knows no file, no store and
no page. `history` keeps the series and acts on the verdicts, `report` shows them.
"""

from typing import TYPE_CHECKING

from elastogeo.changes.causes import Cause, Signatures
from elastogeo.changes.change_points import ChangePoint
from elastogeo.changes.charts import Charts, Judged, Running, start, step
from elastogeo.changes.drifts import DRIFT, STEP, Drift
from elastogeo.changes.due_dates import DUE, NEVER_TESTED, NOT_ASKED, NOT_DUE, OVERDUE, DueDate, due_after, due_of, due_on
from elastogeo.changes.events import Event, OpenAlarm
from elastogeo.changes.fleets import (
    MACHINE_STATES,
    FleetState,
    MachineRow,
    MachineState,
    as_suspected,
    fleet_state,
    machine_row,
    machine_state,
)
from elastogeo.changes.instruments import InstrumentMove, instrument_moves
from elastogeo.changes.kinds import KINDS, Kind
from elastogeo.changes.priors import Prior, default_prior, fleet_prior
from elastogeo.changes.records import (
    CHANGED,
    DANGLING,
    DATABASE_SOUND,
    DOCUMENTS_WHOLE,
    MISSING,
    NO_STRAY_FILES,
    RAW_FILES_WHOLE,
    RECORDS_AGREE,
    REFERENCES_WHOLE,
    RESIZED,
    ROWS_PROTECTED,
    STRAY,
    TRAIL_WHOLE,
    UNPROTECTED,
    UNREADABLE,
    Account,
    AuditFault,
    AuditRow,
    AuditTrail,
    Differing,
    KeptAccounts,
    KeptCampaign,
    KeptJob,
    KeptJobs,
    KeptPlan,
    KeptPlans,
    KeptToken,
    KeptTokens,
    Recomputed,
    RecomputedTest,
    StoreFault,
    Verified,
    as_written,
    recomputed_same,
    trail_whole,
)
from elastogeo.changes.references import Reference, reference_from, reference_of
from elastogeo.changes.result import (
    ALARM,
    NO_BASELINE,
    STATES,
    STEADY,
    SUSPECT,
    WATCH,
    ChangeVerdict,
    IndicatorState,
    Step,
)
from elastogeo.changes.rules import Rule
from elastogeo.changes.run_lengths import cusum_run_length, ewma_run_length, shewhart_run_length
from elastogeo.changes.series import Baseline, Indicator, Series, Tolerance
from elastogeo.changes.verdicts import judge
from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.changes.indicators import indicators_of, signatures_of
    from elastogeo.changes.trials import FaultFound, RuleTest, try_rule
from elastogeo.changes.series import MOST

__all__ = [
    "ALARM",
    "CHANGED",
    "DANGLING",
    "DATABASE_SOUND",
    "DOCUMENTS_WHOLE",
    "DRIFT",
    "DUE",
    "KINDS",
    "MACHINE_STATES",
    "MISSING",
    "MOST",
    "NEVER_TESTED",
    "NOT_ASKED",
    "NOT_DUE",
    "NO_BASELINE",
    "NO_STRAY_FILES",
    "OVERDUE",
    "RAW_FILES_WHOLE",
    "RECORDS_AGREE",
    "REFERENCES_WHOLE",
    "RESIZED",
    "ROWS_PROTECTED",
    "STATES",
    "STEADY",
    "STEP",
    "STRAY",
    "SUSPECT",
    "TRAIL_WHOLE",
    "UNPROTECTED",
    "UNREADABLE",
    "WATCH",
    "Account",
    "AuditFault",
    "AuditRow",
    "AuditTrail",
    "Baseline",
    "Cause",
    "ChangePoint",
    "ChangeVerdict",
    "Charts",
    "Differing",
    "Drift",
    "DueDate",
    "Event",
    "FaultFound",
    "FleetState",
    "Indicator",
    "IndicatorState",
    "InstrumentMove",
    "Judged",
    "KeptAccounts",
    "KeptCampaign",
    "KeptJob",
    "KeptJobs",
    "KeptPlan",
    "KeptPlans",
    "KeptToken",
    "KeptTokens",
    "Kind",
    "MachineRow",
    "MachineState",
    "OpenAlarm",
    "Prior",
    "Recomputed",
    "RecomputedTest",
    "Reference",
    "Rule",
    "RuleTest",
    "Running",
    "Series",
    "Signatures",
    "Step",
    "StoreFault",
    "Tolerance",
    "Verified",
    "as_suspected",
    "as_written",
    "cusum_run_length",
    "default_prior",
    "due_after",
    "due_of",
    "due_on",
    "ewma_run_length",
    "fleet_prior",
    "fleet_state",
    "indicators_of",
    "instrument_moves",
    "judge",
    "machine_row",
    "machine_state",
    "recomputed_same",
    "reference_from",
    "reference_of",
    "shewhart_run_length",
    "signatures_of",
    "start",
    "step",
    "trail_whole",
    "try_rule",
]

__getattr__ = first_use(__name__, {"indicators": "indicators_of signatures_of", "trials": "FaultFound RuleTest try_rule"})
