"""The sections of a worked solution, in letters and numbers.

In: a ``ReportContext``. Out: parts of a sheet. Imports ``analysis``, ``views``, ``report``.
"""
