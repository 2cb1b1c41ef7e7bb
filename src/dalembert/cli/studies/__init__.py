"""The commands of many designs: study and what is below it.

In: a command line. Out: text and files. Imports what the commands do.
"""
