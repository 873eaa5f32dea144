"""The web application: pages over the views, for a browser on this computer or a shop's network.

It computes nothing and formats no number: a page asks the history, takes the view of what comes back, and arranges it. A
page is a file in a wing that holds `pages = Pages()`, and a template; it is found by itself. `guard` says who may come in.
FastAPI and uvicorn come with the extra `web`.
"""

from typing import TYPE_CHECKING, Any

from elastogeo.discovery import first_use
from elastogeo.web.extra import needs_web_extra

if TYPE_CHECKING:
    from elastogeo.web.app import application
    from elastogeo.web.serving import serve
    from elastogeo.web.settings import Settings

_found = first_use(__name__, {"app": "application", "serving": "serve", "settings": "Settings"})

__all__ = ["Settings", "application", "serve"]


def __getattr__(name: str) -> Any:
    """Import a name of the face where it is used first (PEP 562)."""
    with needs_web_extra():
        return _found(name)
