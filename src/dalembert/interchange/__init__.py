"""Files of other programs: read into a mechanism, written from one, and mechanisms that run in other programs.

In: a file of another program, a ``Mechanism`` or a ``Kernel``. Out: a ``Mechanism`` with notes of what the file says
that it does not have, or such a file. ``file_formats`` is the table of suffixes. Imports ``model``, ``analysis`` and
``kernel``.
"""
