"""Readers of run files, one file per format: each registers itself (`elastogeo.formats.run_files` is the contract)."""
