"""The ground of the history: its tables, how a database is opened and migrated, the raw files, the audit trail."""
