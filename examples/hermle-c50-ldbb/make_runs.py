"""Make the simulated runs of this example again, byte for byte, in another folder: `python make_runs.py FOLDER`."""

import shutil
import sys
from pathlib import Path

from elastogeo.formats import poses_of, read_simulation, read_test, write_runs
from elastogeo.sources import simulate

HERE = Path(__file__).parent


def main(folder: Path) -> int:
    folder.mkdir(parents=True)
    shutil.copy(HERE / "test.toml", folder)
    truth = read_simulation(HERE / "simulation.toml")
    planned = read_test(folder, poses_of(truth))
    test = simulate(planned, truth.values, truth.imperfection, truth.seed, truth.exact)
    written = write_runs(folder, test, truth.seed)
    other = [path for path in written if path.read_bytes() != (HERE / "runs" / path.name).read_bytes()]
    print(f"{len(written)} runs in {folder / 'runs'}; {len(other)} differ from those beside this script")
    return 1 if other else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
