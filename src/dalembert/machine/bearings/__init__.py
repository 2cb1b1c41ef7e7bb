"""Bearings of the joints that turn: pressure, PV, equivalent load and life over the cycle, choice from a table.

In: a ``Result``. Out: ``BearingTable``. Imports ``analysis`` and what it imports.
"""
