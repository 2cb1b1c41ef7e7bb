"""Machine elements in plane drawings, to scale: belts, ropes, cams, brakes.

In: a ``Result`` and a position, or the answer of an element. Out: items of a ``Scene``. Imports ``analysis``,
``machine``, ``model``, ``views``.
"""
