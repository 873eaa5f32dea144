"""Who may come in, and what is refused before a page is asked. The layers, the outermost first:

`faults` (no error leaves without a number, no answer without its headers), `lingering` (who is refused sees why), `hosts`
(no name but ours), `sizes` (addresses and headers), `origins` (no other site acts), `visitors` (nobody passes but by
session or token), `bodies` (no body too large or too slow). Each is one file, a function that takes an ASGI application and
gives one. None reads a body before it is known who sends it.
"""

from elastogeo.web.guard.connections import Connection
from elastogeo.web.guard.cookies import session_cookie
from elastogeo.web.guard.doors import guarded
from elastogeo.web.guard.limits import Limits
from elastogeo.web.guard.visitors import UNREADABLE, check_reach

__all__ = ["UNREADABLE", "Connection", "Limits", "check_reach", "guarded", "session_cookie"]
