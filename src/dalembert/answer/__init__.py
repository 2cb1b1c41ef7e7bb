"""Common parts of all answers: reading by name, equality, writers of every format.

In: the names, columns, records and parts of a class. Out: its methods, tables, arrays, records and workbooks. Imports
nothing but the files beside the rooms; drawings and reports inside methods.
"""
