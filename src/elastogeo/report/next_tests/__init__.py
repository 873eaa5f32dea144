"""What comes next: a few ways to reach a goal by tests, each a card; a plan that is kept, as a list to do."""
