"""Readers of logs, one file per format: each registers itself (`elastogeo.formats.log_files` is the contract)."""
