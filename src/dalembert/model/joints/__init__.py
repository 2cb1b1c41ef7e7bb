"""Joints of plane and space, their freedoms, friction and stiffness as a file describes them.

In: a file's keys. Out: frozen joints. Imports ``model``.
"""
