"""A description as numbers for the core: the only room that knows both.

In: a ``Mechanism`` and a ``Schedule``. Out: ``Compiled``: the layout, loads and contacts. Imports ``core``, ``model``.
"""
