"""The studio: a mechanism drawn with the mouse, its forces beside it, and the text of its file as the one truth.

In: gestures and edits from a browser, one file. Out: text, drawings and page data. Imports ``pages``, ``reports`` and
what they import. Operations change characters of the text and nothing else; the front end is ``web/studio``.

Messages are JSON. A tab first sends ``{token}``. Then ``{n, do: {op, ...}}`` (a gesture of ``editing``), ``{n, edit:
[[start, end, text], ...], base: hash}``, ``{n, undo}``, ``{n, redo}``, ``{n, pull}``, ``{n, save}``, ``{n, choose}``,
``{n, options: {static, friction}}``, ``{n, open}``, ``{n, problems}``, ``{n, keys}`` or ``{n, ask}``; n comes
back with the answer, and a refusal is ``{n, refused: sentence}``. Every tab is told the new state (``text``, ``hash``,
``drawing``) at once, and then ``{hash, data}`` of its page, or ``{hash, missing: sentence, path}``. An answer of
``ask`` may be ``{error, path}``; the answers are:

- ``modes``: ``modes``, each with ``svg: {light, dark}``, ``links`` and ``here``, true of the file's own. One is taken
  by ``do: {op: "pose", links, drives: {}}``.
- ``equilibria``: where the mechanism rests without its drive's effort: ``drive``, ``count``, ``rows`` of ``position``
  (SI), ``shown``, ``stability``, ``links``; ``sentence`` where there is none. One is taken by ``do: {op: "pose",
  links, drives: {[drive]: position}}``.
- ``superposition``: ``sources``, and ``rows`` of ``name``, ``unit``, ``values`` by source and their ``sum``.
- ``check``: the file's printed answers; ``report``, ``design``, ``page``: ``file`` (base 64) and ``ending``.
"""
