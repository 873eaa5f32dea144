"""Who may come in, and what is refused before a page is asked."""

from elastogeo.web.guard.doors import guarded

__all__ = ["guarded"]
