"""What an analysis answers: ``Result`` and how its reactions, freedoms and positions are read.

In: arrays of an analysis. Out: numbers by name, in any axes. Imports ``core``, ``model``, ``analysis.compile``.
"""
