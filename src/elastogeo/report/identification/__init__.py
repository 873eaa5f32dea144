"""The report of an identification: its sentences, figures and tables."""
