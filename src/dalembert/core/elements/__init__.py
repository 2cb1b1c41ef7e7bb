"""Rows of A and wrenches of machine elements, beside those of joints.

In: poses and compiled numbers of an element. Out: measures, wrenches and drifts of its rows. Imports ``algebra`` and
``core``.
"""
