"""Rigid-body algebra in the plane (n = 3) and in space (n = 6) under the same names (`protocol`).

In: points, rotations, twists and wrenches as arrays, components last. Out: the same kinds of arrays.
Imports numpy only.
"""
