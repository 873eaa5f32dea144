"""A test folder to begin with: a commented test.toml of any instrument, and a simulation.toml to try it with."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.documents.feed_drives import FILE_NAME as DRIVE_FILE
from elastogeo.formats.documents.machine_tests import FILE_NAME
from elastogeo.formats.documents.machines import find_machine, shipped_machines
from elastogeo.formats.text.whole_files import write_whole
from elastogeo.machine import SPINDLE, Machine
from elastogeo.observe import Template, instrument_named, instruments

DRIVE = "drive"
"""The kind of test that is no instrument on a machine: logs of its feed drives."""

_TEST = """\
schema = "elastogeo.test/1"
name = "{title}"
machine = "{machine}"            # a shipped machine (elastogeo machines), or the path of a machine file from here
instrument = "{instrument}"
resolution_um = {resolution:g}             # of the readings
# simulated = "from what"        # say so if the readings were not measured; runs of elastogeo simulate say it themselves

# [about]                        # for the head of the report
# date = 2026-03-01
# operator = ""
# machine_serial = ""
# instrument_serial = ""

{setup}
# Without a [question] the program asks what this instrument can answer. To ask something else:
# [question]
# parameters = ["C_XXX", "C_??Y"]  # names, patterns or presets: see elastogeo explain

# What is known of systematic influences enters the uncertainty: confirm or correct every size (kinds: docs/formats.md).
{influences}# One entry a run. Columns of a run file: {columns}.
"""

_NO_INFLUENCE = """\
# [[influences]]
# kind = "sensor-scale"
# relative = 0.002

"""

_SIMULATION = """\
schema = "elastogeo.simulation/1"
seed = 1
"""

_DRIVES = """\
schema = "elastogeo.drive/1"
name = "Feed drives"
logs = ["logs/*.csv"]            # each log is a run

# Channels of the logs. A channel whose header says quantity and unit (position_x_mm, current_x_A) needs no entry.
# elastogeo inspect LOG lists the channels of a log.
# [[channels]]
# quantity = "position_x"
# channel = "X1_ActualPosition"
# unit = "mm"

# [clock]
# sample_time_ms = 2             # of logs that keep no clock

# [[drives]]                     # for forces in newtons: motor constant and transmission
# axis = "X"
# torque_constant_N_m_per_A = 1.65
# pitch_mm = 10
# efficiency = 0.9

# held_out = ["run_7"]           # runs that are predicted only
"""


def kinds_of_tests() -> tuple[str, ...]:
    """The kinds of tests of which a new one can be made: instruments that have a template, and `drive`."""
    return (*(name for name, kind in instruments().items() if kind.template is not None), DRIVE)


def new_test(
    folder: str | Path,
    machine: str = "",
    forces: Sequence[float] = (),
    repeats: int = 0,
    instrument: str = "loaded-ball-bar",
    engagements: Sequence[float] = (),
) -> Path:
    """Make a folder with a test file, and a simulation file that its instrument can be tried with.

    Parameters
    ----------
    folder : str or Path
        It must not exist.
    machine : str
        A shipped machine or a machine file; by default one that suits the instrument.
    forces : sequence of float [N]
        Levels, of an instrument that applies a force; by default its usual ones.
    repeats : int
        Runs at each level, and in each direction; 0 for the instrument's usual number.
    instrument : str
        Or `drive`, for logs of feed drives.
    engagements : sequence of float [mm]
        Levels of a ball-roller test.

    Returns
    -------
    Path
        The test file.

    Raises
    ------
    FormatError
        If the folder exists, or there is no such machine.
    InputError
        If there is no such instrument, or it has no such levels.
    """
    folder = Path(folder)
    if folder.exists():
        raise FormatError(f"{folder} is there already; choose another name, nothing was changed")
    if instrument == DRIVE:
        (file,) = write_whole({folder / DRIVE_FILE: _DRIVES.encode()})
        return file
    template = _template_of(instrument)
    levels = _levels(template, instrument, forces, engagements)
    named = machine or template.machine
    found = find_machine(named, Path.cwd())
    template = instrument_named(instrument).template_for(found) or template
    text = _TEST.format(
        title=template.title,
        machine=machine_named_from(named, folder),
        instrument=instrument,
        resolution=template.resolution_um,
        setup=template.setup.replace("@CENTRE@", _centre(found)),
        columns=template.columns,
        influences=template.influences or _NO_INFLUENCE,
    )
    runs = "".join(_runs(template, levels, repeats or template.repeats))
    simulation = _SIMULATION + template.simulation
    write_whole({folder / FILE_NAME: (text + runs).encode(), folder / "simulation.toml": simulation.encode()})
    return folder / FILE_NAME


def _template_of(instrument: str) -> Template:
    known = kinds_of_tests()
    if instrument not in known:
        raise InputError(f"there is no template for {instrument!r}; there are: {', '.join(known)}")
    template = instrument_named(instrument).template
    if template is None:
        raise InputError(f"the instrument {instrument!r} has no template; write its test.toml by hand")
    return template


def _levels(template: Template, instrument: str, forces: Sequence[float], engagements: Sequence[float]) -> tuple[float, ...]:
    asked = {"force": tuple(forces), "engagement": tuple(engagements)}
    strange = next((kind for kind, levels in asked.items() if levels and kind != template.level), "")
    if strange:
        raise InputError(f"a test with {instrument} has no level of {strange}; leave it out")
    return tuple(sorted(asked.get(template.level, ()) or template.levels))


def _runs(template: Template, levels: Sequence[float], repeats: int) -> Iterator[str]:
    """One entry of `runs` for each level, direction and repeat."""
    for level in levels or (0.0,):
        for repeat in range(1, repeats + 1):
            for sense in ("ccw", "cw") if template.both_ways else ("",):
                key, shown = {
                    "force": (f"force_N = {level:g}\n", f"{level:g}N"),
                    "engagement": (f"engagement_um = {1000 * level:g}\n", f"{1000 * level:g}um"),
                }.get(template.level, ("", ""))
                name = "-".join(filter(None, [shown, sense, str(repeat)]))
                turned = f'sense = "{sense}"\n' if sense else ""
                yield f'\n[[runs]]\nfile = "runs/{name}.csv"\n{key}{turned}repeat = {repeat}\n'


def _centre(machine: Machine) -> str:
    axes = (joint for joint in machine.joints if joint.name != SPINDLE)
    return ", ".join(f"{joint.name}_{'deg' if joint.is_rotary else 'mm'} = 0" for joint in axes)


def machine_named_from(machine: str, folder: Path) -> str:
    """A machine as the test names it: a shipped one by name, a file by its path from the folder of the test."""
    if machine in shipped_machines():
        return machine
    return Path(os.path.relpath(machine, folder)).as_posix()
