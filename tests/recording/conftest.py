import importlib.util
import sys
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def rig():
    """The module `rig.py`: a machine, a cable, a recorder."""
    name = "elastogeo_recording_rig"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name("rig.py"))
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    return sys.modules[name]


@pytest.fixture(scope="session")
def machines(rig, tmp_path_factory):
    """Machines by the history that they keep, started once; for tests that leave them running."""
    started = {}

    def machine(history):
        if history not in started:
            started[history] = rig.Machine(tmp_path_factory.mktemp(history), history)
        return started[history]

    yield machine
    for one in started.values():
        one.kill()


@pytest.fixture
def plugged(rig, machines):
    """A running machine with a history of a kind, and a cable of its own to it."""
    cables = []

    def plug(history="none"):
        machine = machines(history)
        cables.append(rig.Cable(machine.port))
        return machine, cables[-1]

    yield plug
    for cable in cables:
        cable.close()
