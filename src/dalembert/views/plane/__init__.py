"""Drawings of plane mechanisms: the mechanism, free bodies, polygons, details of friction.

In: a ``Result``. Out: scenes. Imports ``analysis``, ``views.paper``, ``views.symbols``.
"""
