"""A result written out: columns, CSV, workbook, netCDF, JSON, and as a person reads it.

In: a ``Result``. Out: text, files, tables. Imports ``analysis``.
"""
