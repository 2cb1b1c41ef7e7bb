"""Corners and jumps of loads and efforts, met as events.

In: loads and efforts that contain `sign`, `abs`, `min`, `max` or linear tables. Out: these on one side, and the events
where they change to the other. Imports ``model``, ``analysis`` and the rest of ``machine.motion``.

one_sided       a load or effort whose switches are each on one side
corner_events   a motion's switches: their sides at the start, and going over
"""
