"""Formats of robot simulators: trees of links with joints, loops closed by equalities (MJCF, URDF, SDFormat).

In: a file, or a graph of links. Out: a graph of links, or text.
"""
