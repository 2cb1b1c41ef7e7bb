"""The studio: a mechanism drawn with the mouse, its forces beside it, and the text of its file as the one truth.

In: gestures and edits from a browser, one file. Out: text, drawings and page data. Imports ``pages``, ``reports`` and
what they import. Operations change characters of the text and nothing else; the front end is ``web/studio``.
"""
