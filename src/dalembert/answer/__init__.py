"""What all answers have in common, whatever they are answers to: reading by name, equality, one line for the screen.

In: the names, arrays and statuses of a class. Out: its methods. Imports nothing but the files beside the rooms.
"""
