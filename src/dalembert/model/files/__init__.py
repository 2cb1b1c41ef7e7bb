"""Model files read and written: YAML, JSON and TOML with the line of each value, messages, the schema.

In: text. Out: a tree with its lines, a ``Mechanism``, or a message with file and line. Imports ``model``.
"""
