"""Rigid-body algebra of the plane (n = 3) and of space (n = 6) under the same names (`protocol`).

In: points, rotations, twists and wrenches as arrays, components last. Out: the same kinds of arrays.
Imports numpy only.
"""
