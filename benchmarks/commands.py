"""What a user waits for: wall time and peak memory of whole commands, each in a process of its own, one thread.

    python benchmarks/commands.py [RUNS]

The least of RUNS (3) is the one that the rest of the machine disturbed least; a run before them, not counted, compiles the
modules, as an installation does. Wanted on two quiet cores: 1 s, 4 s, 3 s, 3 s, each within 300 MiB.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
COMMAND = [sys.executable, "-m", "elastogeo"]
ROWS = 2_900_000
"""Of the large CSV: about 46 MB."""
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


def large_csv(folder: Path) -> Path:
    """A run of a ball bar with very many readings: angle and radial deviation."""
    path = folder / "large.csv"
    angle = np.linspace(0, 360, ROWS)
    radial = 5 * np.sin(np.deg2rad(2 * angle))
    with path.open("w", encoding="ascii") as file:
        file.write("angle_deg,radial_um\n")
        for first in range(0, ROWS, 100_000):
            part = slice(first, first + 100_000)
            file.writelines(f"{a:.4f},{r:.3f}\n" for a, r in zip(angle[part], radial[part], strict=True))
    return path


def measured(arguments: list[str], runs: int, compiled: Path) -> tuple[float, float]:
    """Least wall time [s] and greatest memory [MiB] of a command; its modules are compiled into a folder."""
    environment = {**os.environ, **ONE_THREAD, "PYTHONPYCACHEPREFIX": str(compiled), "PYTHONDONTWRITEBYTECODE": ""}
    walls, peaks = [], []
    for _ in range(runs + 1):
        start = time.perf_counter()
        child = subprocess.Popen(arguments, cwd=ROOT, env=environment, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        walls.append(time.perf_counter() - start)
        peaks.append(used.ru_maxrss / 1024)
        if child.returncode:
            raise SystemExit(f"{' '.join(arguments)} ended with {child.returncode}")
    return min(walls[1:]), max(peaks[1:])


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        csv = large_csv(folder)
        example, roller = str(ROOT / "examples" / "hermle-c50-ldbb"), str(ROOT / "examples" / "ball-roller")
        read = "import sys; from elastogeo.formats import read_run; read_run(sys.argv[1])"
        cases = {
            "identify, the example": [*COMMAND, "identify", example],
            "identify, with its report": [*COMMAND, "identify", example, "--report", str(folder / "report")],
            "stiffness, the ball-roller example": [*COMMAND, "stiffness", roller],
            f"read a CSV of {csv.stat().st_size / 1e6:.0f} MB": [sys.executable, "-c", read, str(csv)],
        }
        print(f"{'whole command, one thread':<38}{'wall [s]':>9}{'peak [MiB]':>12}")
        for what, arguments in cases.items():
            wall, peak = measured(arguments, runs, folder / "compiled")
            print(f"{what:<38}{wall:>9.2f}{peak:>12.0f}", flush=True)


if __name__ == "__main__":
    main()
