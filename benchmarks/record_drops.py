"""Lost connections, restarted servers and killed recorders: what a recording keeps of them, counted at the server.

    python benchmarks/record_drops.py [--cuts 20] [--kills 20] [--restarts 5]

Four runs of `elastogeo record` against an OPC UA server in a process of its own (`tests/record/server.py`): with a history
and without; then of a server that is killed and started again, with a history in a file and with one that dies with it. In
each, cables are cut (half of them for a while), and recorders killed at random moments. All values are counters, so every
sample that the server sent between the first and the last one kept is known. Exit code 1 if a sample is missing and not
marked, if one is missing though the server never lost its history, if one is wrong, or if an acknowledged one is gone.
A server that is killed may lose what it neither sent nor put into its history: such samples are marked.
Needs `elastogeo[live]`; takes minutes.
"""

import argparse
import importlib.util
import random
import sys
import tempfile
import time
from pathlib import Path


def load_rig():
    path = Path(__file__).resolve().parents[1] / "tests" / "record" / "rig.py"
    spec = importlib.util.spec_from_file_location("elastogeo_recording_rig", path)
    sys.modules[spec.name] = module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def disturb(machine, cable, recorder, what, seen, rng):
    """One cut of the cable, or one restart of the server; until the recorder is connected again."""
    lost, again = seen
    if what == "cut":
        cable.whole = rng.random() < 0.5
        cable.cut()
    else:
        machine.kill()
    recorder.wait_for("connecting again", lost + 1)
    if what == "cut":
        time.sleep(0 if cable.whole else rng.uniform(0.2, 2.0))
        cable.whole = True
    else:
        machine.start()
    recorder.wait_for(", again.", again + 1)
    recorder.wait_for_parts(rng.randint(1, 3))


def run(rig, folder, history, events, seed):
    """One recording with these events; the summary, the count and what was acknowledged and is not there."""
    rng, target, acknowledged = random.Random(seed), folder / "recording", {}
    rng.shuffle(events)
    with rig.rig(folder, history) as (machine, cable):
        recorder = rig.Recorder(cable.port, target, ("--batch-s", "0.3"))
        recorder.wait_for_parts(2)
        for what in events:
            if what == "kill":
                time.sleep(rng.uniform(0, 0.6))
                recorder.kill()
                acknowledged |= recorder.acknowledged
                recorder = rig.Recorder(cable.port, target, ("--batch-s", "0.3"))
                recorder.wait_for_parts(1)
            else:
                seen = recorder.said("connecting again"), recorder.said(", again.")
                disturb(machine, cable, recorder, what, seen, rng)
        recorder.wait_for_parts(2)
        summary = recorder.stop()
        acknowledged |= recorder.acknowledged
        sent = machine.sent()
    rows = rig.rows_by_part(target)
    gone = sum(count for name, count in acknowledged.items() if rows.get(name) != count)
    return summary, rig.count(target, sent), gone, sum(acknowledged.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cuts", type=int, default=20)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--restarts", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rig, failed = load_rig(), False
    steady = ["cut"] * options.cuts + ["kill"] * options.kills
    restarts = [*["restart"] * options.restarts, *["cut"] * 2, *["kill"] * 2]
    cases = [("memory", steady), ("none", steady), ("file", restarts), ("memory, lost", restarts)]
    for name, events in cases:
        with tempfile.TemporaryDirectory() as place:
            history = str(Path(place) / "history.db") if name == "file" else name.split(",")[0]
            begun = time.monotonic()
            summary, count, gone, acknowledged = run(rig, Path(place), history, list(events), options.seed)
        told = ", ".join(f"{events.count(what)} {what}s" for what in ("cut", "kill", "restart") if what in events)
        filled = sum(channel["filled"] for channel in summary["channels"])
        print(f"history {name}: {told} in {time.monotonic() - begun:.0f} s")
        print(
            f"  sent {count.sent}, kept {count.kept}, missing {count.missing}, of them not marked {count.missing_unmarked}"
        )
        print(f"  gaps marked {count.marked}, wrong {count.wrong}, twice {count.twice}, filled in the last run {filled}")
        print(f"  acknowledged {acknowledged}, of them gone {gone}", flush=True)
        failed |= bool(count.missing_unmarked or count.wrong or gone or (name == "memory" and count.missing))
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
