"""What Jupyter shows of a mechanism, a result, a kernel, a sweep and a force system; and their quantities as curves.

In: these objects. Out: HTML without scripts, a ``Scene``, or axes of matplotlib. Imports ``analysis``, ``wrench``,
``views``.
"""
