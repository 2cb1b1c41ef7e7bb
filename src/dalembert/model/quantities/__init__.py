"""Values as a file writes them: numbers with units, vectors, expressions, tables.

In: numbers and texts. Out: frozen values in SI. Imports ``model``'s base of a part.
"""
