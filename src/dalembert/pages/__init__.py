"""One mechanism as an exact, moving page: the drawings of the views, with every number replaced by a row of the kernel.

In: a description. Out: data for the front end (``page_data``), and a self-contained HTML file (``page``).
Imports ``views``, ``analysis``, ``kernel``. The page itself holds no mechanics: every place, force and couple it draws
is an output of the kernel's WebAssembly; symbols, styles, names and units come from here.
"""
