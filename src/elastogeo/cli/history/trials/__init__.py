"""Commands that need no store of your own: the rules tried out, a fleet to look at."""
