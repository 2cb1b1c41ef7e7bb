"""One mechanism as an exact, moving page: what the views draw, with a row of the kernel in the place of every number.

In: a description. Out: data for the front end (``page_data``), and a self-contained HTML file (``page``).
Imports ``views``, ``analysis``, ``kernel``. The page itself holds no mechanics: every place, force and couple it draws
is an output of the kernel's WebAssembly; symbols, styles, names and units come from here.
"""
