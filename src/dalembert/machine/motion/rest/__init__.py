"""Dry friction and brakes of a moving machine: what slips, sticks and stays at rest.

In: a state of a motion. Out: friction of its contacts, and what is held at rest. Imports ``core``, ``analysis`` and the
rest of ``machine.motion``.

dry_friction   accelerations and friction of contacts together
standstill     what friction and brakes hold
sticking       contacts at rest in machines of several freedoms
"""
