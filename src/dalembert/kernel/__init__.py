"""The core's equations traced into a program, with exact derivatives, and run as machine code.

In: a ``Layout`` made of symbols. Out: a ``Program`` and the arrays that its runs fill: outputs, and a status code for
each position. Imports ``algebra``, ``core``.
"""
