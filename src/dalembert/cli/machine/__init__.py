"""The commands of machine design: shake, balance, flywheel, simulate, members, bearings, motor.

In: a command line. Out: text and files. Imports what the commands do.
"""
