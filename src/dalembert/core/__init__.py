"""Numbers only: the one matrix A, motion and equilibrium at known poses.

Arrays have leading axes (design, position).

In: a ``Layout`` (the connections of links, and the numbers) and poses. Out: velocities, multipliers, residuals as
arrays. Knows no names, files or units. Imports ``algebra``. docs/theory.md has the mechanics.
"""
