"""Machine elements on a page: wheels, belts and ropes.

In: what draws a mechanism's parts, and a joint. Out: items that follow the kernel's rows. Imports
``analysis``, ``views``.
"""
