"""Random plane mechanisms as model trees: drawn in a random configuration first, then the lengths read off.

Links are added in groups that neither add nor take freedoms beyond their drives, so the mobility is the number of
drives, nothing is redundant, and the drawn configuration is one position in closed form.

``random_case(seed)`` -> drawing, tree in SI, the oracle's answer
``tree(drawing, ...)`` -> model tree, moved, in other units, with loads scaled, joints' i and j exchanged
"""

from tests.random_mechanisms.drawing import Drawing, Rigid
from tests.random_mechanisms.growth import Case, random_case, random_mechanism
from tests.random_mechanisms.writing import (
    IN_LBF,
    MM_N,
    SI,
    Scale,
    Style,
    exchangeable,
    mirrored,
    pose_array,
    tree,
)

__all__ = [
    "IN_LBF", "MM_N", "SI", "Case", "Drawing", "Rigid", "Scale", "Style",
    "exchangeable", "mirrored", "pose_array", "random_case", "random_mechanism", "tree",
]  # fmt: skip
