"""The version of elastogeo, in one place."""

VERSION = "0.1.0"
