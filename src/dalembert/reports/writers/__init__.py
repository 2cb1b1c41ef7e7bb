"""A sheet as PDF, HTML, LaTeX or plain text.

In: a sheet. Out: text or a file. Imports ``views.paper``, ``views.formats``, ``report``.
"""
