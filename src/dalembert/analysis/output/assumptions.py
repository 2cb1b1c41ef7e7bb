"""What the numbers of a result rest on, each as a phrase."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from dalembert.analysis.compile.torsion_turns import count_notes
from dalembert.analysis.friction import joint_friction
from dalembert.analysis.result.joint_freedoms import whole_pose
from dalembert.model.gravity import STANDARD
from dalembert.model.space_checks import impossible, principal_inertias

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


def assumptions(result: Result) -> dict[str, str]:
    """Gravity, inertia, joint_friction, how reactions beyond statics were found, which whole turn torsion
    springs count, inertias that no real body has.

    >>> import dalembert as da
    >>> da.statics(da.four_bar()).assumptions["inertia"]
    'off (static)'
    """
    gravity = result.mechanism.gravity_vector
    shown = "[" + ", ".join(f"{c:.6g}" for c in gravity) + "] m/s2"
    if result.mechanism.gravity == "standard":
        shown = f"standard ({STANDARD:.6g} m/s2 along -{'xyz'[len(gravity) - 1]})"
    found = {
        "gravity": shown if any(gravity) else "none",
        "inertia": "on (D'Alembert)" if result.inertia else "off (static)",
        "friction": joint_friction.assumption(result),
    }
    if result.compiled.layout.compliance is not None and result.unique_array is not None:
        found["redundant reactions"] = "by the joints' stiffness, links rigid, free of stress without load"
    found |= count_notes(result.compiled, whole_pose(result))
    return found | (_doubts(result.mechanism) if result.inertia else {})


SMALLEST, LARGEST = 2e-3, 100.0
"""Radii of gyration, over the reach of their link and over the largest reach, beyond which a unit is likely wrong."""


def _doubts(m: Mechanism) -> dict[str, str]:
    """Inertias that no real body has, or only one of quite another size: analysed all the same."""
    found = [name for name in m.links if m.dimension == 3 and impossible(m.inertia(name))]
    said = "of no real body: one principal value exceeds the sum of the others"
    doubts = {f"inertia of {' and '.join(found)}": said} if found else {}
    reach = {name: _reach(m, name) for name in m.links}
    largest = max(reach.values(), default=0.0)
    for name in m.links:
        radius, far = _gyration(m, name), reach[name]
        if radius and largest and not SMALLEST * far < radius < LARGEST * largest:
            size = f"that of a radius of gyration of {radius:.3g} m, with points up to {far:.3g} m"
            doubts.setdefault(f"inertia of {name}", f"{size} from the mass centre: check its unit")
    return doubts


def _gyration(m: Mechanism, link: str) -> float:
    """Largest radius of gyration of a link about its mass centre, m; 0 where it is not written or has no mass."""
    mass = m.mass(link)
    if not mass or m.links[link].shapes:
        return 0.0
    return math.sqrt(max(principal_inertias(m.inertia(link))[-1], 0.0) / mass)


def _reach(m: Mechanism, link: str) -> float:
    """Distance of the mass centre from the farthest point of a link, m."""
    center = m.center(link)
    return max((math.dist(center, p) for p in m.points(link).values()), default=0.0)
