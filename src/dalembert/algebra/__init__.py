"""Rigid-body algebra of the plane (n = 3) and of space (n = 6) under the same names; numpy only."""
