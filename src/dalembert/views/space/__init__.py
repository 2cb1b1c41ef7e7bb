"""Drawings in space through a camera, and solids for 3-D files.

In: a ``Result`` and a direction. Out: scenes, solids. Imports ``analysis``, ``views.paper``, ``views.symbols``.
"""
