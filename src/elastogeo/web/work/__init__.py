"""The pages of work: what is uploaded, planned, and takes long."""
