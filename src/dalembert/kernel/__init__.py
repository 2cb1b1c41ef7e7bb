"""The core's equations traced into a program, with exact derivatives, and run as machine code.

In: a ``Layout`` made of symbols. Out: a ``Program`` and what its runs fill: numbers and marks of positions in doubt.
Imports ``algebra``, ``core``.
"""
