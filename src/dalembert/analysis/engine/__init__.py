"""Answers from kept programs: a structure is traced once, then evaluated for any numbers in it at any positions.

In: a compiled mechanism of the plane. Out: a ``Result`` whose positions are all ok, or none where the careful path
(``analysis.one_pass``) has to look: wheels in mesh, friction, groups without closed form, gaps, dead centres, doubt.
"""
