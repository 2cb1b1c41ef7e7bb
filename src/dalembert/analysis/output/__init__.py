"""Output of a result: columns, CSV, workbook, netCDF, JSON, and printed text.

In: a ``Result``. Out: text, files, tables. Imports ``analysis``.
"""
