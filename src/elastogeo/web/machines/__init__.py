"""The pages of machines: the fleet, one machine, its tests, what they say together."""
