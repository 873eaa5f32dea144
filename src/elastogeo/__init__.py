"""elastogeo: loaded-test metrology of machine tools.

Where is this machine soft, where is it crooked, how sure are we, and what could this test not tell?

    import elastogeo as eg

    result = eg.identify(eg.read_test("my-test"))
    print(result)
    print(result["C_XXX"])
    result.report("my-report")

This is the public face: what is listed here is what tutorials use, and nothing else is promised. A name is imported when it
is used first, so that `import elastogeo` costs nothing. The rooms behind it, from the ground up: `estimate`, `machine`,
`drive`, `observe`, `sources`, `formats`, `identification`, `prediction`, `planning`, `changes`, `report`, `history`,
`recording`, `cli`; imports only go down.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from elastogeo import version

if TYPE_CHECKING:
    from elastogeo.errors import ElastogeoError, InputError, UnsupportedError
    from elastogeo.estimate import Estimate
    from elastogeo.formats import (
        example_test,
        inspect_file,
        machines,
        new_test,
        read_campaign,
        read_cut,
        read_design,
        read_drives,
        read_log,
        read_machine,
        read_path,
        read_program,
        read_run,
        read_test,
        simulate,
        write_program,
        write_tests,
    )
    from elastogeo.history import History
    from elastogeo.identification import (
        calibrate,
        compare,
        diagnose,
        evaluate_positioning,
        evaluate_static,
        explain,
        identify,
        identify_drives,
        map_stiffness,
        what_if,
    )
    from elastogeo.machine import Machine
    from elastogeo.observe import Campaign, MachineTest
    from elastogeo.planning import plan
    from elastogeo.prediction import compensate, compensate_path, map_compliance, predict
    from elastogeo.result import Result

__version__ = version.VERSION

_HOME = {
    "Campaign": "observe",
    "ElastogeoError": "errors",
    "Estimate": "estimate",
    "History": "history",
    "InputError": "errors",
    "Machine": "machine",
    "MachineTest": "observe",
    "Result": "result",
    "UnsupportedError": "errors",
    "calibrate": "identification",
    "compare": "identification",
    "compensate": "prediction",
    "compensate_path": "prediction",
    "diagnose": "identification",
    "evaluate_positioning": "identification",
    "evaluate_static": "identification",
    "example_test": "formats",
    "explain": "identification",
    "identify": "identification",
    "identify_drives": "identification",
    "inspect_file": "formats",
    "machines": "formats",
    "map_compliance": "prediction",
    "map_stiffness": "identification",
    "new_test": "formats",
    "plan": "planning",
    "predict": "prediction",
    "read_campaign": "formats",
    "read_cut": "formats",
    "read_design": "formats",
    "read_drives": "formats",
    "read_log": "formats",
    "read_machine": "formats",
    "read_path": "formats",
    "read_program": "formats",
    "read_run": "formats",
    "read_test": "formats",
    "simulate": "formats",
    "what_if": "identification",
    "write_program": "formats",
    "write_tests": "formats",
}
"""The room of each name of the face."""

__all__ = [
    "Campaign",
    "ElastogeoError",
    "Estimate",
    "History",
    "InputError",
    "Machine",
    "MachineTest",
    "Result",
    "UnsupportedError",
    "__version__",
    "calibrate",
    "compare",
    "compensate",
    "compensate_path",
    "diagnose",
    "evaluate_positioning",
    "evaluate_static",
    "example_test",
    "explain",
    "identify",
    "identify_drives",
    "inspect_file",
    "machines",
    "map_compliance",
    "map_stiffness",
    "new_test",
    "plan",
    "predict",
    "read_campaign",
    "read_cut",
    "read_design",
    "read_drives",
    "read_log",
    "read_machine",
    "read_path",
    "read_program",
    "read_run",
    "read_test",
    "simulate",
    "what_if",
    "write_program",
    "write_tests",
]


def __getattr__(name: str) -> Any:
    """Import a name of the face from its room, once (PEP 562)."""
    if name not in _HOME:
        raise AttributeError(f"elastogeo has no {name!r}; it has {', '.join(__all__)}")
    found = globals()[name] = getattr(import_module(f"elastogeo.{_HOME[name]}"), name)
    return found


def __dir__() -> list[str]:
    """The names of the face, for completion."""
    return sorted(__all__)
