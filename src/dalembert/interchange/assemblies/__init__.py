"""Assemblies as graphs of parts with markers: files of FreeCAD's solver, command files of Adams View.

In: a ``LinkGraph``, or a file. Out: the text of a file, or a graph. Imports ``model``, ``analysis`` and the graph.
"""
