"""Keep a history whole: copies while others work, a place filled from a copy, everything as files, the check of it all."""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.history.upkeep.backups import back_up
    from elastogeo.history.upkeep.exports import export
    from elastogeo.history.upkeep.manifests import Copied
    from elastogeo.history.upkeep.restores import restore
    from elastogeo.history.upkeep.verification import verify

__all__ = ["Copied", "back_up", "export", "restore", "verify"]

__getattr__ = first_use(
    __name__,
    {
        "backups": "back_up",
        "exports": "export",
        "manifests": "Copied",
        "restores": "restore",
        "verification": "verify",
    },
)
