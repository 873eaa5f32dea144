"""The pages of people: who logs in, and who may do what."""
