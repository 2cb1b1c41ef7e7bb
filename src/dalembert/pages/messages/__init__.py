"""Messages of a page: on the numbers that it accepts or rejects, and on positions without an answer.

In: a description, its kernel and result. Out: the messages of the model and of the analyses, with placeholders.
Imports ``pages.rows``, ``analysis``, ``model``.
"""
