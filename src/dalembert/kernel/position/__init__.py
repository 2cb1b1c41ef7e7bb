"""Poses of a traced mechanism in closed form, group by group; Newton unrolled elsewhere.

In: relations of the layout's rows. Out: traced poses.
Imports ``core``, ``kernel``.
"""
