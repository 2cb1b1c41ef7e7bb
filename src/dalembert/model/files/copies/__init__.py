"""Parts of a mechanism written once and copied: `copies` of a file, expanded to links, joints and loads.

In: a file's tree. Out: the tree without `copies`, the copy that each new part came from, and the relations of copies to
originals. Imports ``model``.
"""
