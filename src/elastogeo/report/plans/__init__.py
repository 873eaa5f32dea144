"""What is shown of a plan of tests."""
