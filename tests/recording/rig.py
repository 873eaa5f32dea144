"""A machine, a cable that can be cut, a recorder: each a process (the cable: threads); and the count of what was kept."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from elastogeo.formats.recording_files import part_files, read_head, read_table, standing_gaps

PATIENCE = 120.0
STEP = 1_000_000
NODES = ("Axis0.Position", "Axis1.Current", "Axis2.Position", "Axis3.Current")


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def node_of(name: str) -> str:
    return f"ns=2;i={1000 + NODES.index(name)}" if name in NODES else f"ns=2;s={name}"


def until(condition: Callable[[], object], what: str, patience: float = PATIENCE) -> None:
    end = time.monotonic() + patience
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited {patience} s in vain until {what}")
        time.sleep(0.01)


class Machine:
    """The server of `server.py`, that counts on when it is started again."""

    def __init__(self, folder: Path, history: str = "none", rate: float = 50.0, keys: Path | None = None) -> None:
        self.port, self.truth = free_port(), folder / "truth.csv"
        self.options = ["--history", history, "--rate", str(rate), "--channels", str(len(NODES))]
        self.options += ["--keys", str(keys)] if keys else []
        self.process: subprocess.Popen[str] | None = None
        self.start()

    def start(self) -> None:
        script = Path(__file__).with_name("server.py")
        command = [sys.executable, str(script), "--port", str(self.port), "--truth", str(self.truth), *self.options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout
        assert self.process.stdout.readline() == "ready\n"

    def kill(self) -> None:
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            assert self.process.stdout
            self.process.stdout.close()
            self.process = None

    def sent(self) -> dict[int, int]:
        """Time [ns] by number, of each tick."""
        lines = self.truth.read_text().splitlines()
        return {int(number): int(moment) for number, moment in (line.split(",") for line in lines if line.count(",") == 1)}


class Cable:
    """Passes bytes between a recorder and a server; can be cut, and cut for good until it is mended."""

    def __init__(self, port: int) -> None:
        self.target, self.whole, self.frozen = port, True, False
        self._pairs: list[tuple[socket.socket, socket.socket]] = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self) -> None:
        while True:
            try:
                near, _ = self._listener.accept()
            except OSError:
                return
            if not self.whole:
                near.close()
                continue
            try:
                far = socket.create_connection(("127.0.0.1", self.target))
            except OSError:
                near.close()
                continue
            self._pairs.append((near, far))
            for one, other in ((near, far), (far, near)):
                threading.Thread(target=self._pass, args=(one, other), daemon=True).start()

    def _pass(self, one: socket.socket, other: socket.socket) -> None:
        with suppress(OSError):
            while data := one.recv(65536):
                while self.frozen:
                    time.sleep(0.01)
                other.sendall(data)
        for end in (one, other):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def cut(self) -> None:
        pairs, self._pairs = self._pairs, []
        for pair in pairs:
            for end in pair:
                with suppress(OSError):
                    end.shutdown(socket.SHUT_RDWR)
                end.close()

    def close(self) -> None:
        self._listener.close()
        self.frozen = False
        self.cut()


@dataclass
class Recorder:
    """One process of `elastogeo record`, and what it says."""

    port: int
    folder: Path
    options: tuple[str, ...] = ()
    nodes: tuple[str, ...] = NODES
    plan: str = ""
    secrets: tuple[tuple[str, str], ...] = ()
    lines: list[str] = field(default_factory=list)
    acknowledged: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        server = f"opc.tcp://127.0.0.1:{self.port}/machine"
        if self.plan:
            file = self.folder.with_suffix(".toml")
            file.write_text(f'server = "{server}"\n{self.plan}\n[[channel]]\nname = "x"\nnode = "i=1"\n')
            server = str(file)
        nodes = [word for name in self.nodes for word in ("-n", f"{name}[mm]={node_of(name)}")]
        command = [sys.executable, "-m", "elastogeo", "record", server, *nodes]
        command += ["-o", str(self.folder), "--json", "--sampling-ms", "20", *self.options]
        environment = {**os.environ, "PYTHONUNBUFFERED": "1", **dict(self.secrets)}
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stderr
        for line in self.process.stderr:
            self.lines.append(line.rstrip())
            if line.startswith("part-") and "samples kept" in line:
                name, count = line.split(": ")
                self.acknowledged[name] = int(count.split()[0])

    def said(self, words: str) -> int:
        return sum(words in line for line in self.lines)

    def wait_for(self, words: str, times: int = 1) -> None:
        until(lambda: self.said(words) >= times or self.process.poll() is not None, f"it says {words!r} {times} times")
        assert self.said(words) >= times, self.lines

    def wait_for_parts(self, more: int = 1) -> None:
        self.wait_for("samples kept", self.said("samples kept") + more)

    def kill(self) -> None:
        self.process.kill()
        self._end()

    def stop(self) -> dict:
        """End it as Ctrl-C does; its summary."""
        self.process.send_signal(signal.SIGINT)
        return self.summary()

    def summary(self) -> dict:
        assert self.process.stdout
        out = self.process.stdout.read()
        self._end()
        assert self.process.returncode == 0, self.lines
        return json.loads(out)

    def refusal(self) -> str:
        """What it says when it ends with exit code 2."""
        assert self.process.stdout
        out = self.process.stdout.read()
        self._end()
        assert (self.process.returncode, out) == (2, ""), self.lines
        return "\n".join(self.lines)

    def _end(self) -> None:
        self.process.wait(PATIENCE)
        self._reader.join(PATIENCE)
        for stream in (self.process.stdout, self.process.stderr):
            assert stream
            stream.close()


@dataclass(frozen=True)
class Count:
    """What is in a folder, against what the machine sent between the first and the last sample that was kept."""

    sent: int
    kept: int
    missing: int
    missing_unmarked: int
    wrong: int
    twice: int
    marked: int


def count(folder: Path, sent: dict[int, int]) -> Count:
    """Count all channels of a recording."""
    heads = [read_head(path) for path in part_files(folder).values()]
    gaps = standing_gaps(heads)
    totals: Counter[str] = Counter()
    tables = [read_table(path.read_bytes(), str(path)) for path in part_files(folder).values()]
    for channel, name in enumerate(NODES):
        chosen = [np.array(table.column("channel").to_pylist()) == name for table in tables]
        times = [table.column("time").cast("int64").to_numpy()[one] for table, one in zip(tables, chosen, strict=True)]
        values = [table.column("value").to_numpy()[one] for table, one in zip(tables, chosen, strict=True)]
        pairs = list(zip(np.concatenate(times).tolist(), np.concatenate(values).tolist(), strict=True))
        numbers = [int(value) - channel * STEP for _, value in pairs]
        kept = set(numbers)
        wrong = sum(sent.get(number) != moment for number, (moment, _) in zip(numbers, pairs, strict=True))
        expected = {number for number in sent if min(kept) <= number <= max(kept)}
        missing = expected - kept
        own = [gap for gap in gaps if gap.channel == name]
        hidden = [
            n for n in missing if not any(gap.start < sent[n] and (gap.end is None or sent[n] < gap.end) for gap in own)
        ]
        totals.update(sent=len(expected), kept=len(kept), missing=len(missing), missing_unmarked=len(hidden))
        totals.update(wrong=wrong, twice=len(numbers) - len(kept), marked=len(own))
    return Count(**{name: totals[name] for name in Count.__dataclass_fields__})


def rows_by_part(folder: Path) -> dict[str, int]:
    return {path.name: read_table(path.read_bytes(), str(path)).num_rows for path in part_files(folder).values()}


@contextmanager
def rig(folder: Path, history: str = "none", **options: Any) -> Iterator[tuple[Machine, Cable]]:
    machine = Machine(folder, history, **options)
    cable = Cable(machine.port)
    try:
        yield machine, cable
    finally:
        cable.close()
        machine.kill()
