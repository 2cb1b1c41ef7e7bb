"""Result of an analysis: ``Result`` and access to its reactions, freedoms and positions.

In: arrays of an analysis. Out: numbers by name, in any axes. Imports ``core``, ``model``, ``analysis.compile``.
"""
