"""Plane linkages as other programs draw them, joints at coordinates: PMKS+, PMKS, pylinkage, DXF.

In: a file, or a mechanism. Out: the tree of a model file with notes of what is not kept, or such a file.
"""
