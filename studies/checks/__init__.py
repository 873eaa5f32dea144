"""The studies, one file a check: each defines `STUDY` and is found by being here or in a wing.

`identifiable.py` shows how.
"""

from __future__ import annotations

import pkgutil
from importlib import import_module

from studies.rates import Study


def studies() -> dict[str, Study]:
    """Every study by the name of its file, with that of its wing before it, in its order on the page."""
    files = [file.name for file in pkgutil.walk_packages(__path__, f"{__name__}.") if not file.ispkg]
    found = {name.removeprefix(f"{__name__}."): import_module(name).STUDY for name in files}
    return dict(sorted(found.items(), key=lambda item: (item[1].order, item[0])))
