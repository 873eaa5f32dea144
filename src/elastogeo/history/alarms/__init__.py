"""Alarms: what a verdict opens, whom it tells and how often, and what a person does about it.

`life` decides which steps an alarm takes, `telling` which of them is told; both are pure. `assessing` judges a series and
writes state, steps and messages in one transaction; `delivery` sends the messages by `channels`, each a file that
registers itself. Stands on the ground wing `store` and on `changes`.
"""

from typing import TYPE_CHECKING, Any

from elastogeo.discovery import first_use
from elastogeo.history.extra import needs_history_extra

if TYPE_CHECKING:
    from elastogeo.history.alarms.acts import acknowledge, close
    from elastogeo.history.alarms.addresses import add_recipient, recipients, remove_recipient, try_recipient
    from elastogeo.history.alarms.assessing import assess, assess_waiting
    from elastogeo.history.alarms.delivery import deliver
    from elastogeo.history.alarms.judging import judged
    from elastogeo.history.alarms.open_ones import lately, simulated, standing, unknown
    from elastogeo.history.alarms.silences import end_of, silence_machine
    from elastogeo.history.alarms.states import fleet
    from elastogeo.history.alarms.told import kept_alarm
    from elastogeo.history.alarms.trying import try_rule_of

_found = first_use(
    __name__,
    {
        "acts": "acknowledge close",
        "assessing": "assess assess_waiting",
        "delivery": "deliver",
        "judging": "judged",
        "addresses": "add_recipient recipients remove_recipient try_recipient",
        "open_ones": "lately simulated standing unknown",
        "silences": "end_of silence_machine",
        "states": "fleet",
        "told": "kept_alarm",
        "trying": "try_rule_of",
    },
)

__all__ = [
    "acknowledge",
    "add_recipient",
    "assess",
    "assess_waiting",
    "close",
    "deliver",
    "end_of",
    "fleet",
    "judged",
    "kept_alarm",
    "lately",
    "recipients",
    "remove_recipient",
    "silence_machine",
    "simulated",
    "standing",
    "try_recipient",
    "try_rule_of",
    "unknown",
]


def __getattr__(name: str) -> Any:
    """Import a name of the face where it is used first (PEP 562)."""
    with needs_history_extra():
        return _found(name)
