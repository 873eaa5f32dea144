"""Feed drives from logs: the torque balance of each axis, models of its friction judged by runs that were left out.

Stands on the files of `identification` and on `drive`.
"""

from elastogeo.identification.feed_drives.axis_drives import (
    AxisDrive,
    DriveIdentification,
    DriveParameter,
    ModelScore,
    identify_drives,
)

__all__ = [
    "AxisDrive",
    "DriveIdentification",
    "DriveParameter",
    "ModelScore",
    "identify_drives",
]
