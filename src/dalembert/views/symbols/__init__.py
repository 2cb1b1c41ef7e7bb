"""The field's symbols of joints, in plane and space.

In: a place. Out: primitives or solids.
"""
