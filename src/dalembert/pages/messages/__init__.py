"""What a page says: which numbers it takes and why not others, and why a position has no answer.

In: a description, its kernel and result. Out: the messages of the model and of the analyses, with places to fill.
Imports ``pages.rows``, ``analysis``, ``model``.
"""
