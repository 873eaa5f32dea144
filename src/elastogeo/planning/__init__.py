"""Which tests to run: candidates, what they tell, the choice among them. Stands on `prediction` and all below."""
