"""Notebook displays of a mechanism, a result, a kernel, a sweep and a force system; plots of their quantities.

In: these objects. Out: HTML without scripts, a ``Scene``, or axes of matplotlib. Imports ``analysis``, ``wrench``,
``views``.
"""
