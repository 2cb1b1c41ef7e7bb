"""Links: named points, mass properties, and shapes or meshes from which these follow.

In: a file's keys. Out: frozen links. Imports ``model``.
"""
