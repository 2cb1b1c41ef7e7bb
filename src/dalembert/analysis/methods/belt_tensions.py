"""Pull of belts on their shafts as loads: what superposition and virtual work have beside the loads of the file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, State, link_place
from dalembert.core.elements.belt_pulls import BeltPulls, belts
from dalembert.core.forcing import WrenchSource, belt_forces, belt_source

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def belt_tensions(r: Result, at: State) -> Iterator[tuple[str, BeltPulls, WrenchSource]]:
    """Each belt with its pull alone, and the wrenches of that on its links, those of i first."""
    layout, pulls = r.compiled.layout, r.compiled.forcing.belts
    if pulls is None:
        return
    names = [
        name
        for name, joint in r.mechanism.joints.items()
        if joint.WRAPPED and hasattr(joint, "stated_tension")
    ]
    for k, name in enumerate(names):
        one = np.arange(len(names)) == k
        alone = replace(pulls, **{key: one * getattr(pulls, key) for key in ("constant", "mass", "share")})
        yield name, alone, belt_source(layout, alone, at.pose, at.moving.twist)


def tension_actions(r: Result, at: State) -> Iterator[Action]:
    """The pulls, with what follows the torque, as forces at the centres of both wheels."""
    layout, rows = r.compiled.layout, r.compiled.layout.constraints
    f = belts(layout)
    if f is None:
        return
    x = np.zeros((len(r.status), rows.count))
    x[:, f.row] = r.moment_array[:, rows.joint[f.row]] / f.rj
    ((_, force, _),) = belt_forces(layout, r.compiled.forcing.belts, at.pose, at.moving.twist, x)
    for k, row in enumerate(f.row):
        name = r.joints[rows.joint[row]]
        ends = zip(r.mechanism.joints[name].links, r.mechanism.joint_points(name), (-1.0, 1.0), strict=True)
        for link, u, side in ends:
            pull, none = side * force[:, k], np.zeros(len(r.status))
            yield Action(name, "spring", f"tension of {name}", link, None, link_place(r, link, u), pull, none)
