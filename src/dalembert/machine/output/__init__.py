"""What all answers of this room have in common: a table over the positions, a record, and text.

In: an answer with ``columns`` and ``record``. Out: CSV, JSON, text. Imports ``analysis.output``.
"""
