"""The group `elastogeo history`: machines and their tests over the years, and what has changed."""

GROUP = "Keep the tests of machines, and say what has changed."
ORDER = (
    "init", "import", "watch", "list", "show", "compare", "baseline", "tolerance", "interval", "machine",
    "instrument", "event", "aside", "campaign", "plan", "recompute", "acknowledge", "close", "silence", "recipient",
    "deliver", "digest", "account", "token", "export", "backup", "restore", "verify", "audit", "work", "rules",
    "demo",
)  # fmt: skip
"""In which the help lists the commands."""
