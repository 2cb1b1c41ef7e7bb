"""Independent answers: these modules import nothing of dalembert.

``lagrange``   multipliers in redundant Cartesian coordinates, derivatives by sympy; reads the model tree
``energy``     positions in closed form on jets, efforts by virtual power; no reaction, no matrix
``hand``       the nine (eight) D'Alembert equations of the four-bar (slider-crank), written out
``space``      the same kind of answers in space: hand solutions, and natural coordinates for any mechanism

Symbols: q the links' (x, y, angle), v and a its rates, P positions, L links (ground first).
"""
