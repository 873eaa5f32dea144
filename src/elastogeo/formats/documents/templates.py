"""A test folder to begin with: a commented test.toml, and a simulation.toml to try it with."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from elastogeo.errors import FormatError
from elastogeo.formats.documents.machine_tests import FILE_NAME
from elastogeo.formats.documents.machines import find_machine
from elastogeo.formats.text.whole_files import write_whole

_TEST = """\
schema = "elastogeo.test/1"
name = "Loaded ball bar test"
machine = "{machine}"          # a shipped machine (elastogeo machines) or a machine file beside this one
instrument = "loaded-ball-bar"
resolution_um = 0.24             # of the radial readings
# simulated = "from what"        # say so here, if the readings were not measured

[setup]
feed_mm_min = 2000
# setup_deflection_um_per_bar = 2.33   # Eq. 5.38; needs pressure_bar in every run
# tool_mm = [0, 0, -160]               # tool ball in the last tool-side carriage, if not the machine's own tool point

[setup.circle]
radius_mm = 150
plane = "XY"                     # XY, YZ, ZX, or two directions: [[1, 0, 0], [0, 0.8, 0.6]]
centre = {{ {centre} }}            # axis commands at the centre; rotary axes are held where this says

# Asked for, unless a [question] says otherwise: compliance, geometry and location; each run has its own circle centre.
# To ask for something else: [question] with parameters = [...], names, patterns (C_??X) or presets.

# One entry a run. Columns of a run file: angle_deg, radial_um (or other units).
# Instead of force_N a run may have pressure_bar, with [setup.calibration] pressure_bar = [...], force_N = [...].
"""

_RUN = """
[[runs]]
file = "runs/{name}.csv"
force_N = {force:g}
sense = "ccw"
repeat = {repeat}
"""

_SIMULATION = """\
schema = "elastogeo.simulation/1"
seed = 1
readings = 1000                  # of a full turn

[imperfection]
noise_um = 0.07
resolution_um = 0.24
eccentricity_um = 0.2            # of the centre, from run to run
force_scatter = 0.002            # relative, from run to run

[values]                         # true parameters, in mm, N, rad
C_XXX = 6e-5
C_YYY = 5e-5
E_XX1 = -1e-4
"""


def new_test(
    folder: str | Path, machine: str = "hermle_c50", forces: Sequence[float] = (36.0, 238.0, 490.0, 742.0), repeats: int = 1
) -> Path:
    """Make a folder with a test file and a simulation file.

    Parameters
    ----------
    folder : str or Path
        It must not exist.
    machine : str
        A shipped machine or a machine file.
    forces : sequence of float [N]
        Levels.
    repeats : int
        Runs at each level.

    Returns
    -------
    Path
        The test file.

    Raises
    ------
    FormatError
        If the folder exists, or there is no such machine.
    """
    folder = Path(folder)
    found = find_machine(machine, Path.cwd())
    if folder.exists():
        raise FormatError(f"{folder} is there already; choose another name, nothing was changed")
    centre = ", ".join(
        f"{joint.name}_{'deg' if joint.is_rotary else 'mm'} = 0" for joint in found.joints if joint.name != "S"
    )
    runs = "".join(
        _RUN.format(name=f"{force:g}N-{repeat}", force=force, repeat=repeat)
        for force in sorted(forces)
        for repeat in range(1, repeats + 1)
    )
    name = machine if not machine.endswith(".toml") else str(Path(machine).resolve())
    text = _TEST.format(machine=name, centre=centre) + runs
    write_whole({folder / FILE_NAME: text.encode(), folder / "simulation.toml": _SIMULATION.encode()})
    return folder / FILE_NAME
