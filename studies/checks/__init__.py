"""The studies, one file a check: each defines `STUDY` and is found by being here. `identifiable.py` shows how."""

from __future__ import annotations

import pkgutil
from importlib import import_module

from studies.rates import Study


def studies() -> dict[str, Study]:
    """Every study by its file's name, in its order on the page."""
    found = {name: import_module(f"{__name__}.{name}").STUDY for _, name, _ in pkgutil.iter_modules(__path__)}
    return dict(sorted(found.items(), key=lambda item: (item[1].order, item[0])))
