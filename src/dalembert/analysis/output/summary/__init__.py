"""Printed form of a result: tables and sentences, for the command line and ``print(result)``.

In: a ``Result``. Out: text. Imports ``analysis``.
"""
