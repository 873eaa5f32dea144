"""Views of alarms: what a person is told of one, those that wait for somebody, who is told, and what was sent."""
