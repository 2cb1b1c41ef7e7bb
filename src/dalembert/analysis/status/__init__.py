"""Status of each position, and the sentence that gives the reason if it is not solved.

In: the path, motion and forces of the positions. Out: statuses and sentences. Imports ``core``, ``model``,
``analysis.compile``, ``analysis.friction``, ``analysis.result``.
"""
