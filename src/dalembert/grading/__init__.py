"""A student's answers judged, and the answers that stand in a model file compared.

In: a ``Mechanism`` and answers with their units. Out: verdicts, with the usual mistake that explains a wrong figure.
Imports ``analysis``, ``model``.
"""
