"""Motions of many designs as they go on side by side, each from event to event.

In: the machine code and the guards of a machine, and states at the start. Out: the steps and events of each design.
Imports ``machine.motion`` and the program of its rates.

guards         quantities whose change of sign is an event
course_state   the data of the designs
course_rest    their start, and what holds them at rest
course_stops   impacts on stops, clutches that hold
course_steps   steps up to the next event
course_events  events, and the segments behind them
"""
