"""A result as a person reads it: tables and sentences, printed by the command line and by ``print(result)``.

In: a ``Result``. Out: text. Imports ``analysis``.
"""
