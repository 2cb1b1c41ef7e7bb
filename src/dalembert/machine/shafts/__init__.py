"""Shafts: critical speeds of a link that bends between its bearings, with the masses on it.

In: a ``Result`` and a link with a section. Out: answers that print and draw themselves. Imports what ``machine`` does.
"""
