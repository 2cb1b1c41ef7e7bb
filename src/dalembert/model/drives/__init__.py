"""Drives: which freedom each prescribes, its positions, its law in time, all drives' positions together.

In: a file's keys. Out: frozen drives and the ``Schedule`` of an analysis. Imports ``model``.
"""
