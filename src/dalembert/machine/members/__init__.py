"""Forces inside links, stresses and safety of a section; pins, bearings and motors chosen by the cycle.

In: a ``Result``. Out: numbers over the positions with their largest over the cycle. Imports what ``machine`` imports.
"""
