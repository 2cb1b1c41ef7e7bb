"""Output of a study: text, tables, drawings and a page.

In: a ``StudyResult``. Out: text, files, scenes, a ``ReportSheet``. Imports ``studies``, ``views``, ``reports``.
"""
