"""A scene as SVG, PDF, PNG, DXF, and mechanisms in motion as SVG, GIF, WebP, GLB.

In: a ``Scene`` or a ``Result``. Out: files. Imports ``views``.
"""
