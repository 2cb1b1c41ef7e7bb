"""Judges a student's answers, and compares the answers in a model file with the computed ones.

In: a ``Mechanism`` and answers with their units. Out: verdicts, with the usual mistake that explains a wrong figure.
Imports ``analysis``, ``model``.
"""
