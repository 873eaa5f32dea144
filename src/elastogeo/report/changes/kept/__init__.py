"""What a history keeps beside its tests: campaigns, events, and the readings of one test to look into."""
