"""Features common to all answers: access by name, equality, a one-line representation.

In: the names, arrays and statuses of a class. Out: its methods. Imports only the top-level modules.
"""
