"""Feed drives from logs: the torque balance of each axis, models of its friction judged by runs that were left out.

Stands on the files of `identification` and on `drive`.
"""

from elastogeo.identification.feed_drives.axis_drives import identify_drives
from elastogeo.identification.feed_drives.models import CANDIDATES, rmse_of
from elastogeo.identification.feed_drives.result import (
    LEFT_OUT,
    AxisDrive,
    DriveIdentification,
    DriveParameter,
    ModelScore,
    Rest,
)

__all__ = [
    "CANDIDATES",
    "LEFT_OUT",
    "AxisDrive",
    "DriveIdentification",
    "DriveParameter",
    "ModelScore",
    "Rest",
    "identify_drives",
    "rmse_of",
]
