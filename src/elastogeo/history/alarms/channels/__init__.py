'''Channels: how a message reaches a person. To add one, write one file in this folder; it is found and registered by itself.

The contract tests in `tests/history/alarms/test_channels.py` run on it at once. A complete one, `toy.py`::

    """The toy channel: a file for each message, in a folder."""

    from pathlib import Path

    from elastogeo.errors import DeliveryError, InputError
    from elastogeo.history.alarms.channels.channel import Channel, register


    def check(address, settings):
        if not Path(address).is_absolute():
            raise InputError(f"{address!r} is no folder from the root; give it in full")


    def send(message, address, settings):
        try:
            (Path(address) / f"{message.key}.txt").write_text(message.text, encoding="utf-8")
        except OSError as error:
            raise DeliveryError(f"{address}: {error.strerror}") from None


    register(Channel("toy", check, send, sample="/tmp"))

What the contract asks:

* `check` refuses with an `InputError` what is no address of the channel: a person sees it when he enters a recipient;
* `send` returns when the receiver has taken the message, within a minute, or raises a `DeliveryError`: it is tried again
  later unless the error is `lasting`. The same message may come twice (a crash between sending and noting it), so `send`
  hands on `message.key`, by which a receiver knows it again;
* passwords and secrets come from `settings`, the environment's variables, never from the address; no error shows them.
'''

from elastogeo.history.alarms.channels.channel import Channel, Message, channel, channels

__all__ = ["Channel", "Message", "channel", "channels"]
