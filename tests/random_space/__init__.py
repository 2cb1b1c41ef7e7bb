"""Random mechanisms in space as model trees: drawn in a random pose, then each link's numbers read off in its axes.

``random_case(seed)`` -> drawing, well conditioned
``tree(drawing, Options(...))`` -> model tree, moved, in other units, loads scaled, joints' i and j exchanged, shuffled
"""

from tests.random_space.drawing import Drawing, Rigid, turned_frame
from tests.random_space.growth import random_case, random_drawing
from tests.random_space.writing import IN_LBF, MM_N, SI, Options, Style, exchangeable, tree

__all__ = [
    "IN_LBF", "MM_N", "SI", "Drawing", "Options", "Rigid", "Style",
    "exchangeable", "random_case", "random_drawing", "tree", "turned_frame",
]  # fmt: skip
