"""A drawing as data: primitives in millimetres of paper, their scale, letters and places of labels.

In: primitives. Out: a ``Scene``. Knows no mechanics.
"""
