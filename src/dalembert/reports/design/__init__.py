"""The design report: one document for a machine, composed of what the other answers compute, with verdicts.

In: a ``Result``. Out: a ``ReportSheet``. Imports ``machine``, ``views``, ``reports``.
"""
