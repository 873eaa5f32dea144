"""Alarms: what a verdict opens, whom it tells and how often, and what a person does about it.

`life` decides which steps an alarm takes, `telling` which of them is told; both are pure. `assess` judges a series and
writes state, steps and messages in one transaction; `delivery` sends the messages by `channels`, each a file that
registers itself. Stands on the ground wing `store` and on `changes`.
"""
