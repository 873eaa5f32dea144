"""Channels: how a message reaches a person; one file each, which registers itself (`channel` says how)."""

from elastogeo.history.alarms.channels.channel import Channel, Message, channel, channels

__all__ = ["Channel", "Message", "channel", "channels"]
