"""Whether a position has an answer: its status and the sentence that says why not.

In: the path, motion and forces of the positions. Out: statuses and sentences. Imports ``core``, ``model``,
``analysis.compile``, ``analysis.friction``, ``analysis.result``.
"""
