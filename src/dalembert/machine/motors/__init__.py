"""Motors: what a drive asks for over the cycle, the gear ratio that needs least torque, and whether a motor is enough.

In: a ``Result``. Out: ``MotorChoice``. Imports ``analysis``, ``core``, ``machine`` and what they import.
"""
