"""What a person wants of a series: the tests that count as its ordinary state, its tolerances, how often it is tested."""
