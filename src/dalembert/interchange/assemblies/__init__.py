"""Assemblies as graphs of parts with markers: files of FreeCAD's solver.

In: a ``LinkGraph``. Out: the text of a file. Imports ``model``, ``analysis`` and the graph.
"""
