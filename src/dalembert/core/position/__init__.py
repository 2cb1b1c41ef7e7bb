"""Pose of the links: the first pose, the motion that continues it, and corrections by Newton's method.

In: a ``Layout``, targets of its rows, the known part of the first pose. Out: poses, and which were reached.
Imports ``algebra``, ``core``.
"""
