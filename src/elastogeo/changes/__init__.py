"""Has it changed? A series of tests becomes charts, limits, states and a verdict, without a database.

Stands on all rooms below, mostly on `identification` and `prediction` for what an indicator is; knows no file, no store and
no page. `history` keeps the series and acts on the verdicts, `report` shows them.
"""

from elastogeo.changes.kinds import KINDS, Kind
from elastogeo.changes.series import Baseline, Indicator, Series

__all__ = ["KINDS", "Baseline", "Indicator", "Kind", "Series"]
