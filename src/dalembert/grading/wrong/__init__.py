"""The problem with one thing wrong: loads, data, geometry, the wrenches on a link.

In: a ``Result``. Out: sentences with the answers that such mistakes lead to. Imports ``analysis`` and ``model``.
"""
