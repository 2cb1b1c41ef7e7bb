"""Gestures on the text of a model file.

In: a text, the pose that is drawn, a message of the browser. Out: the text with the characters changed that the gesture
is about. Imports ``model``, ``analysis``, ``core`` and ``pages``.
"""
