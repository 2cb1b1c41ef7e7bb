"""Drawings of machine design.

In: an answer of ``machine``. Out: ``Scene``. Imports ``machine`` and what ``views`` imports.
"""
