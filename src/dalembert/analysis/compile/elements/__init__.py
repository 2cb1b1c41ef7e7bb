"""Machine elements of a description as rows, contacts and numbers for the core.

In: the mechanism, its joints and their geometry. Out: rows of A, contacts, records of ``core.elements``. Imports
``core`` and ``model``.
"""
