"""Exam variants of a problem: values drawn, each variant checked, question and solution sheets, and a key.

In: a ``Mechanism`` and the values that may be drawn. Out: ``Variants``, a folder of sheets. Imports ``analysis``,
``grading``, ``model``, ``reports``, ``views``.
"""
