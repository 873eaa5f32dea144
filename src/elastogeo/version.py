"""The version of elastogeo, in one place."""

VERSION = "0.2.0"
