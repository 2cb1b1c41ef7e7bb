"""The methods on paper as readings of a result: members, superposition, virtual work, forces one by one.

In: a ``Result``. Out: tables of named numbers. Imports ``analysis``.
"""
