"""The solution as on paper: one free body, one equation, one unknown number after the other.

In: a ``Result`` at one position. Out: ``ForceSteps``: steps with their terms, the blocks, the check; the closed forms
of the positions and rates; the arms of a superposition. Imports ``core``, ``model`` and the rest of ``analysis``.
"""
