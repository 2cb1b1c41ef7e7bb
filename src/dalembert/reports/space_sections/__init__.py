"""The sections of a worked solution that only space has.

In: a ``ReportContext``. Out: parts of a sheet. Imports ``analysis``, ``views``, ``report``.
"""
