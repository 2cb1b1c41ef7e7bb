"""Assumptions behind the numbers of a result, each as a phrase."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.compile.torsion_turns import count_notes
from dalembert.analysis.friction import joint_friction
from dalembert.analysis.methods.applied_forces import link_place
from dalembert.analysis.output.summary.printed_turning import turning_note
from dalembert.analysis.result.joint_freedoms import freedom_motion, full_pose
from dalembert.model.gravity import STANDARD, gravity_doubt
from dalembert.model.space_checks import impossible, principal_inertias

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.arrays import Array
    from dalembert.model import Mechanism
    from dalembert.model.drives.end_stops import Stops


def assumptions(result: Result) -> dict[str, str]:
    """Gravity, inertia, joint_friction, the method for statically indeterminate reactions, the full turns that torsion
    springs count, brakes, motors and stops that a prescribed motion leaves out, inertias that no real body has.

    >>> import dalembert as da
    >>> da.statics(da.four_bar()).assumptions["inertia"]
    'off (static)'
    """
    gravity = result.mechanism.gravity_vector
    shown = "[" + ", ".join(f"{c:.6g}" for c in gravity) + "] m/s2"
    if result.mechanism.gravity == "standard":
        shown = f"standard ({STANDARD:.6g} m/s2 along -{'xyz'[len(gravity) - 1]})"
    doubt = gravity_doubt(gravity)
    notes = {
        "gravity": (f"{shown} ({doubt})" if doubt else shown) if any(gravity) else "none",
        "inertia": "on (D'Alembert)" if result.inertia else "off (static)",
        "friction": joint_friction.assumption(result),
    }
    notes |= turning_note(result.mechanism)
    if result.compiled.layout.compliance is not None and result.unique_array is not None:
        notes["redundant reactions"] = "by the joints' stiffness, links rigid, free of stress without load"
    notes |= count_notes(result.compiled, full_pose(result)) | _left_to_forces(result)
    return notes | (_doubts(result.mechanism) if result.inertia else {})


def _left_to_forces(r: Result) -> dict[str, str]:
    """Brakes, motors and starts that only a motion under forces has, and stops that the positions go beyond."""
    m, notes = r.mechanism, {}
    for name, drive in m.drives.items():
        effort, unit = ("moment", "N m") if drive.turns else ("force", "N")
        if drive.brake:
            notes[f"brake of {name}"] = (
                f"not counted apart: the effort is the {effort} of motor and brake together; while it slips the motor "
                f"gives {drive.brake:.6g} {unit} more in the direction of motion, at rest the brake takes up to as much"
            )
        if drive.motor is not None:
            notes[f"motor of {name}"] = "not used: the effort is what the prescribed motion needs"
        if name in m.start:
            notes[f"start of {name}"] = "not used: the drive is prescribed (simulate starts from it)"
        if drive.stops is not None and name in r.schedule.names:
            notes |= _beyond(
                f"stops of {name}", drive.stops, r.schedule.position[:, r.schedule.names.index(name)]
            )
    for name, joint in m.joints.items():
        if (stops := getattr(joint, "stops", None)) is not None and r.ok.any():
            which = "slide" if stops.kind == "length" else "turn"
            notes |= _beyond(f"stops of {name}", stops, freedom_motion(r, name, which)[0])
    return notes | _beyond_tables(r)


def _beyond_tables(r: Result) -> dict[str, str]:
    """Springs whose length goes beyond the table of their force."""
    m, notes = r.mechanism, {}
    for name, load in m.loads_on("span").items():
        if (law := getattr(load, "law", None)) is not None:
            ends = [link_place(r, link, u) for link, u in m.load_points(name)]
            change = np.hypot.reduce((ends[1] - ends[0]).T) - load.free_length
            past = np.count_nonzero((change < law.x[0] - PAST) | (change > law.x[-1] + PAST))
            if past:
                many = f"{past} of {len(change)} positions {'is' if past == 1 else 'are'} beyond its ends"
                notes[f"table of {name}"] = f"{many}, where its first or last force is kept"
    return notes


def _beyond(what: str, stops: Stops, positions: Array) -> dict[str, str]:
    """Stops that some of the positions are beyond."""
    past = np.count_nonzero((positions < stops.least - PAST) | (positions > stops.greatest + PAST))
    many = f"{past} of {len(positions)} positions {'is' if past == 1 else 'are'} beyond them"
    return {what: f"not counted: {many}, where a stop would push"} if past else {}


PAST = 1e-9
"""Distance beyond a stop, m or rad, that is rounding."""
SMALLEST, LARGEST = 2e-3, 100.0
"""Radii of gyration, over the reach of their link and over the largest reach, beyond which a unit is likely wrong."""


def _doubts(m: Mechanism) -> dict[str, str]:
    """Inertias that no real body has, or only one of quite another size: analysed all the same."""
    links = [name for name in m.links if m.dimension == 3 and impossible(m.inertia(name))]
    text = "of no real body: one principal value exceeds the sum of the others"
    doubts = {f"inertia of {' and '.join(links)}": text} if links else {}
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
