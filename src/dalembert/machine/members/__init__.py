"""Forces inside links, stresses and safety of a section, fatigue and buckling.

In: a ``Result``. Out: numbers over the positions with their largest over the cycle. Imports what ``machine`` imports.
"""
