"""Accounts and tokens as views."""
