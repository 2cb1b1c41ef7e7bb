"""From a description to the trace of its analysis: numbers that vary become symbols, outputs become nodes.

In: a ``Mechanism``, the paths of the numbers that vary. Out: a ``Trace``, and its outputs by name.
Imports ``kernel``, ``core``, ``analysis``.
"""
