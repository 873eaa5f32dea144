"""The pages of care: alarms, instruments, settings, the audit trail, copies."""
