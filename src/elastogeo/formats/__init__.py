"""Readers and writers: one file per format, found by content; machine, test and simulation files.

Stands on `sources`, `observe`, `machine` and `errors`.
"""

from elastogeo.formats.channels import ChannelUse, Clock, OnOneClock, on_one_clock
from elastogeo.formats.drive_files import read_drives
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.log_files import LogFormat, log_formats, read_log
from elastogeo.formats.log_parquet import read_recording
from elastogeo.formats.machine_files import find_machine, read_machine, shipped_machines
from elastogeo.formats.new_test import write_new_test
from elastogeo.formats.run_files import RunFormat, read_run, run_formats
from elastogeo.formats.simulation_files import Simulation, full_turn, poses_of, read_simulation, write_runs
from elastogeo.formats.table import Table
from elastogeo.formats.trial_files import example_test, read_test

__all__ = [
    "Channel",
    "ChannelUse",
    "Clock",
    "Log",
    "LogFormat",
    "OnOneClock",
    "RunFormat",
    "Simulation",
    "Table",
    "example_test",
    "find_machine",
    "full_turn",
    "log_formats",
    "on_one_clock",
    "poses_of",
    "read_drives",
    "read_log",
    "read_machine",
    "read_recording",
    "read_run",
    "read_simulation",
    "read_test",
    "run_formats",
    "shipped_machines",
    "write_new_test",
    "write_runs",
]
