"""Balancing: counterweights under bounds with the proof of optimality, rotors, engines.

For a prescribed motion every force, moment and effort is linear in the mass numbers p = (m, m x, m y, I) of each
counterweight: a convex problem. In: a description. Out: ``Balance``. Imports ``analysis``, ``machine``.
"""
