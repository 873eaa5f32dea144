"""Keep a history whole: copies while others work, a place filled from a copy, everything as files, the check of it all."""

from elastogeo.discovery import first_use

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
