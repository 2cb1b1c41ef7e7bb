"""Quantities of machine elements, for numbers and for the nodes of a compiled analysis, and what a result says of one.

In: a ``Result`` or a compiled analysis. Out: arrays or nodes by the name of a drive or a joint. Imports ``analysis``.
"""
