"""Answers from kept programs: a structure is traced once, then evaluated for any numbers in it at any positions.

In: a compiled mechanism. Out: a ``Result`` whose positions are all ok; or its motion, in the plane; or, where its
motion is known, its forces, with friction too. None where the careful path (``analysis.one_pass``) has to look:
positions of wheels in mesh, of groups without closed form and in space, gaps, dead centres, rest, reversals, doubt.
"""
