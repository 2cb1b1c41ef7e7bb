"""Common output of the answers in this package: a table over the positions, a record, and text.

In: an answer with ``columns`` and ``record``. Out: CSV, JSON, text. Imports ``analysis.output``.
"""
