"""Dry friction around the same A: contacts, their semi-smooth equations, impending motion at rest, losses.

In: contacts, the factored A and the wrenches without friction. Out: friction forces and what is known of them.
Imports ``algebra``, ``core``.
"""
