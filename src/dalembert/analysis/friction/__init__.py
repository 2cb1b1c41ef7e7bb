"""Friction's questions: equilibrium with it, verdicts, circles, lines of action, efficiency, the taught iteration.

In: a compiled mechanism, or a ``Result``. Out: forces, sentences, readings.
Imports ``core``, ``analysis``.
"""
