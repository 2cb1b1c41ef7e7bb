"""Machine elements by themselves: cams, governors, pins, the heat of brakes, what a cylinder needs, and its column.

In: a mechanism, a result or a motion, and the name of an element. Out: numbers and files of it. Imports ``analysis``
and what it imports.
"""
