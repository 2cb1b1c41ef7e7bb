"""Flywheels: the energy curve of a machine, the flywheel it needs, and its exact speed over the cycle.

In: a ``Result`` of a machine with one drive, at even positions over full turns, or pulses of energy. Out: ``Flywheel``,
``FlywheelSize``. Imports ``analysis``, ``core``, ``machine``.
"""
