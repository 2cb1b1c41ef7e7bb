"""Analyses of friction: equilibrium, verdicts, circles, lines of action, efficiency, the textbook iteration.

In: a compiled mechanism, or a ``Result``. Out: forces, sentences, readings.
Imports ``core``, ``analysis``.
"""
