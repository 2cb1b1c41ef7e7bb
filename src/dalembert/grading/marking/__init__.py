"""Grading of a class: sheets and tables, a key, a rubric, marks with follow-through, a workbook and feedback.

In: files of answers and a key. Out: ``ClassMarks``. Imports ``grading``, ``analysis``, ``core``, ``model``.
"""
