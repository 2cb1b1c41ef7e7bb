"""Dry friction as a nonlinear load on the same linear system A x + w = 0: contacts, Newton, rest, losses.

In: contacts, the factored A and the wrenches without friction. Out: friction forces and their properties.
Imports ``algebra``, ``core``.
"""
