"""The choice among candidates: the space that they see, goals, greedy choice with exchange."""
