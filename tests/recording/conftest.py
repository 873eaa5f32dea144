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
