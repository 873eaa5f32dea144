"""Readers and writers: one file per format, found by content; machine, test and simulation files.

Stands on `sources`, `observe`, `machine` and `errors`.
"""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.formats.channel_uses import ChannelUse, Clock
    from elastogeo.formats.channels import OnOneClock, on_one_clock
    from elastogeo.formats.compensation_files import (
        CompensationFormat,
        compensation_format,
        compensation_formats,
        compensation_text,
        read_back,
        read_compensation,
    )
    from elastogeo.formats.documents.calibrations import (
        CalibrationDocument,
        DeflectionDocument,
        calibration_text,
        read_calibration,
        write_calibration,
    )
    from elastogeo.formats.documents.campaigns import CampaignParts, campaign_parts, read_campaign
    from elastogeo.formats.documents.cuts import read_cut
    from elastogeo.formats.documents.designs import Design, read_design
    from elastogeo.formats.documents.feed_drives import read_drives
    from elastogeo.formats.documents.machine_tests import example_test, full_turn, read_test, run_files_of
    from elastogeo.formats.documents.machines import find_machine, machines, read_machine, shipped_machines
    from elastogeo.formats.documents.planned_tests import write_tests
    from elastogeo.formats.documents.simulated_tests import simulate
    from elastogeo.formats.documents.simulations import Simulation, poses_of, read_simulation, write_runs
    from elastogeo.formats.documents.templates import kinds_of_tests, new_test
    from elastogeo.formats.documents.tests_with_files import TestWithFiles, read_with_files
    from elastogeo.formats.inspection import Inspected, InspectedColumn, inspect_file
    from elastogeo.formats.log import Channel, Log
    from elastogeo.formats.log_files import LogFormat, log_formats, read_log
    from elastogeo.formats.logs.parquet import read_recording
    from elastogeo.formats.program_files import (
        Flavour,
        Reading,
        Writing,
        flavours,
        program_text,
        programs_of,
        read_program,
        read_program_bytes,
        write_program,
        write_programs,
    )
    from elastogeo.formats.recording_files import (
        INITIAL,
        SCHEMA,
        Gap,
        PartHead,
        RecordedChannel,
        Samples,
        encode_part,
        part_files,
        part_name,
        read_head,
        read_table,
        said_gap,
        said_time,
        standing_gaps,
    )
    from elastogeo.formats.run_files import RunFormat, read_run, run_formats
    from elastogeo.formats.text.files_read import confined_to
    from elastogeo.formats.text.table import Table
    from elastogeo.formats.text.whole_files import write_whole
    from elastogeo.formats.tool_paths import force_of_table, path_of_table, read_forces, read_path

__all__ = [
    "INITIAL",
    "SCHEMA",
    "CalibrationDocument",
    "CampaignParts",
    "Channel",
    "ChannelUse",
    "Clock",
    "CompensationFormat",
    "DeflectionDocument",
    "Design",
    "Flavour",
    "Gap",
    "Inspected",
    "InspectedColumn",
    "Log",
    "LogFormat",
    "OnOneClock",
    "PartHead",
    "Reading",
    "RecordedChannel",
    "RunFormat",
    "Samples",
    "Simulation",
    "Table",
    "TestWithFiles",
    "Writing",
    "calibration_text",
    "campaign_parts",
    "compensation_format",
    "compensation_formats",
    "compensation_text",
    "confined_to",
    "encode_part",
    "example_test",
    "find_machine",
    "flavours",
    "force_of_table",
    "full_turn",
    "inspect_file",
    "kinds_of_tests",
    "log_formats",
    "machines",
    "new_test",
    "on_one_clock",
    "part_files",
    "part_name",
    "path_of_table",
    "poses_of",
    "program_text",
    "programs_of",
    "read_back",
    "read_calibration",
    "read_campaign",
    "read_compensation",
    "read_cut",
    "read_design",
    "read_drives",
    "read_forces",
    "read_head",
    "read_log",
    "read_machine",
    "read_path",
    "read_program",
    "read_program_bytes",
    "read_recording",
    "read_run",
    "read_simulation",
    "read_table",
    "read_test",
    "read_with_files",
    "run_files_of",
    "run_formats",
    "said_gap",
    "said_time",
    "shipped_machines",
    "simulate",
    "standing_gaps",
    "write_calibration",
    "write_program",
    "write_programs",
    "write_runs",
    "write_tests",
    "write_whole",
]

__getattr__ = first_use(
    __name__,
    {
        "channel_uses": "ChannelUse Clock",
        "channels": "OnOneClock on_one_clock",
        "compensation_files": "CompensationFormat compensation_format compensation_formats "
        "compensation_text read_back read_compensation",
        "documents.calibrations": "CalibrationDocument DeflectionDocument "
        "calibration_text read_calibration write_calibration",
        "documents.campaigns": "CampaignParts campaign_parts read_campaign",
        "documents.cuts": "read_cut",
        "documents.designs": "Design read_design",
        "documents.feed_drives": "read_drives",
        "documents.machine_tests": "example_test full_turn read_test run_files_of",
        "documents.machines": "find_machine machines read_machine shipped_machines",
        "documents.planned_tests": "write_tests",
        "documents.simulated_tests": "simulate",
        "documents.simulations": "Simulation poses_of read_simulation write_runs",
        "documents.templates": "kinds_of_tests new_test",
        "documents.tests_with_files": "TestWithFiles read_with_files",
        "inspection": "Inspected InspectedColumn inspect_file",
        "log": "Channel Log",
        "log_files": "LogFormat log_formats read_log",
        "logs.parquet": "read_recording",
        "program_files": "Flavour Reading Writing flavours "
        "program_text programs_of read_program read_program_bytes write_program write_programs",
        "recording_files": "Gap INITIAL PartHead RecordedChannel SCHEMA Samples encode_part "
        "part_files part_name read_head read_table said_gap said_time standing_gaps",
        "run_files": "RunFormat read_run run_formats",
        "text.files_read": "confined_to",
        "text.table": "Table",
        "text.whole_files": "write_whole",
        "tool_paths": "force_of_table path_of_table read_forces read_path",
    },
)
