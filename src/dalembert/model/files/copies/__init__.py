"""Parts of a mechanism written once and copied: `copies` of a file, read as the links, joints and loads they stand for.

In: a file's tree. Out: the tree without `copies`, which copy each new part came from, and how copies are alike.
Imports ``model``.
"""
