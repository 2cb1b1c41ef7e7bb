"""All oracle mechanisms, by name."""

from __future__ import annotations

from copy import deepcopy

import numpy as np

from tests.oracles import energy, linkages, machines
from tests.oracles.parts import Example

EXAMPLES: dict[str, Example] = {
    example.name: example
    for example in (
        linkages.four_bar(), linkages.slider_crank(), machines.inverted_slider_crank(), machines.scotch_yoke(),
        machines.shaper(), linkages.watt(), linkages.stephenson3(), linkages.five_bar(), linkages.five_bar(geared=True),
        machines.planetary(), machines.rolling_wheel(), machines.scissor(), machines.double_pendulum(),
        linkages.bucket(), linkages.slotted_rod(),
    )
}  # fmt: skip


def assembled(example: Example) -> Example:
    """With the `assembly` of the first position, rounded, except where it fixes the phase of a mesh."""
    q = energy.solve(example.tree, example.kinematics).q
    tree = deepcopy(example.tree)
    names = [name for name in tree["links"] if name != "ground"]
    tree["assembly"] = {name: float(np.degrees(q[0, k + 1, 2])) for k, name in enumerate(names)}
    return Example(example.name, tree, example.kinematics)
