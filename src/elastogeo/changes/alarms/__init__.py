"""Alarms as results, which the history fills: their steps, how they stand, whom they told."""

from elastogeo.changes.alarms.kept import AlarmMessage, AlarmStep, KeptAlarm
from elastogeo.changes.alarms.messages import Delivered, Delivery, Recipient, Recipients
from elastogeo.changes.alarms.standing import AlarmList, AlarmNews, AlarmRow, FailedRow, OverdueRow, SilenceRow
from elastogeo.changes.alarms.steps import ACKNOWLEDGED, CLOSED, FALSE, HELD, OPEN, RELEASED, REPAIRED, WORSE

__all__ = [
    "ACKNOWLEDGED",
    "CLOSED",
    "FALSE",
    "HELD",
    "OPEN",
    "RELEASED",
    "REPAIRED",
    "WORSE",
    "AlarmList",
    "AlarmMessage",
    "AlarmNews",
    "AlarmRow",
    "AlarmStep",
    "Delivered",
    "Delivery",
    "FailedRow",
    "KeptAlarm",
    "OverdueRow",
    "Recipient",
    "Recipients",
    "SilenceRow",
]
