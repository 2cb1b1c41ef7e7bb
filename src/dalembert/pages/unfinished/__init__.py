"""A mechanism that is not finished as a page: its sketch, and the steps that finish it.

In: a description whose drives do not match its freedoms, or that does not close. Out: the page's data. Imports what
`pages` imports, and `pages`.
"""
