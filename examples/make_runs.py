"""Make the simulated runs of an example again, byte for byte, in another folder: `python make_runs.py EXAMPLE FOLDER`."""

import shutil
import sys
from pathlib import Path

from elastogeo.formats import poses_of, read_simulation, read_test, write_runs
from elastogeo.sources import simulate


def main(example: Path, folder: Path) -> int:
    folder.mkdir(parents=True)
    for path in example.glob("*.toml"):
        shutil.copy(path, folder)
    truth = read_simulation(folder / "simulation.toml")
    planned = read_test(folder, poses_of(truth), truth.setup)
    test = simulate(planned, truth.values, truth.imperfection, truth.seed, truth.exact)
    written = write_runs(folder, test, truth.seed)
    there = [example / path.relative_to(folder) for path in written]
    other = [
        old for old, new in zip(there, written, strict=True) if not old.exists() or old.read_bytes() != new.read_bytes()
    ]
    print(f"{len(written)} runs in {folder}; {len(other)} differ from those of {example}")
    return 1 if other else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
