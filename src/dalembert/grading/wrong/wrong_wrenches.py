"""Mistakes that change forces and couples on links, as differences from those of the problem.

The answer is linear in them, so each costs one product with the factored A (``analysis.methods.superposition``).

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, joint_place, known_actions, slide_direction
from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class WrenchChange(NamedTuple):
    """A mistake: how usual it is (1 to 3), in words, and what it adds to the forces and couples on the links."""

    order: int
    sentence: str
    added: tuple[Action, ...]


FACTORS = (
    (10.0, "is ten times too large"),
    (0.1, "is ten times too small"),
    (4.0, "has an area with the diameter as radius, or pi d^2"),
    (0.25, "has an area too small by 4"),
    (1e3, "is too large by 1000"),
    (1e-3, "is too small by 1000"),
)
"""Factors of a load, in words."""


def wrench_changes(r: Result) -> Iterator[WrenchChange]:
    """Loads, moments, masses and accelerations, one wrong at a time."""
    actions = [a for a in known_actions(r) if a.link in r.links]
    yield from _load_changes(r, actions)
    if r.mechanism.dimension == 2:
        yield from _moment_changes(r, actions)
    yield from _mass_changes(r, actions)
    if r.inertia:
        yield from _inertia_of_one(r, actions)
        if r.mechanism.dimension == 2:
            for link in r.links:
                yield from _acceleration_changes(r, link)
                yield from _two_masses(r, actions, link)
            yield from _without_coriolis(r)


def _times(some: Sequence[Action], factor: float) -> tuple[Action, ...]:
    """Change of some actions by a factor."""
    return tuple(replace(a, force=a.force * (factor - 1), couple=a.couple * (factor - 1)) for a in some)


def _force(like: Action, force: Array) -> Action:
    """A force at the point of an action."""
    return replace(like, force=np.broadcast_to(force, like.force.shape), couple=np.zeros_like(like.couple))


def _couple(link: str, couple: Array) -> Action:
    """A couple (P,) on a link of a plane mechanism."""
    zero = np.zeros((len(couple), 2))
    return Action("", "load", "", link, None, zero, zero, couple)


def _load_changes(r: Result, actions: list[Action]) -> Iterator[WrenchChange]:
    by_name: dict[str, list[Action]] = {}
    for a in actions:
        if a.kind == "load":
            by_name.setdefault(a.of, []).append(a)
    for name, some in by_name.items():
        for factor, words in FACTORS:
            yield WrenchChange(3, f"load {name} {words}", _times(some, factor))
    forces = {name: some[0] for name, some in by_name.items() if len(some) == 1 and some[0].force.any()}
    for name, a in forces.items():
        for k, axis in enumerate("xyz"):
            component = a.force * (np.arange(a.force.shape[1]) == k)
            if component.any():
                yield WrenchChange(3, f"the {axis} component of {name} is left out", (_force(a, -component),))
    for (one, a), (two, b) in combinations(forces.items(), 2):
        both = (_force(a, b.force - a.force), _force(b, a.force - b.force))
        yield WrenchChange(3, f"loads {one} and {two} are exchanged", both)
    if r.mechanism.dimension == 2:
        yield from _directions(r, forces)


def _directions(r: Result, forces: dict[str, Action]) -> Iterator[WrenchChange]:
    """Directions with degrees mistaken for radians, or counted from the links."""
    turned = []
    for name, a in forces.items():
        angle = np.degrees(np.arctan2(a.force[:, 1], a.force[:, 0])) % 360
        size = np.hypot(*a.force.T)
        mistaken = size[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        words = f"the direction of {name}: degrees are mistaken for radians"
        yield WrenchChange(3, words, (_force(a, mistaken - a.force),))
        c, s = np.cos(r.angle(a.link)), np.sin(r.angle(a.link))
        x, y = a.force.T
        turned.append(_force(a, np.stack([c * x - s * y, s * x + c * y], axis=-1) - a.force))
    if len(turned) > 1:
        yield WrenchChange(2, "the directions of all loads are counted in link axes", tuple(turned))


def _moment_changes(r: Result, actions: list[Action]) -> Iterator[WrenchChange]:
    """The moment of a force about a joint of its link left out, or of the wrong sign; all with a wrong sign."""
    for a in actions:
        if not a.force.any():
            continue
        name = a.source or a.of
        for joint in joints_of(r, a.link):
            moment = replace(a, couple=np.zeros_like(a.couple)).moment(joint_place(r, joint))
            if np.abs(moment).max() <= 1e-9 * float(np.abs(a.force).max()) * r.compiled.layout.length:
                continue
            words = f"the moment of {name} about {joint}"
            yield WrenchChange(2, f"{words} is left out", (_couple(a.link, -moment),))
            yield WrenchChange(2, f"{words} has the wrong sign", (_couple(a.link, -2 * moment),))
    signs = [
        _couple(
            a.link,
            2 * (a.at - r.point_array[:, r.links.index(a.link)] - r.compiled.origin)[:, 1] * a.force[:, 0],
        )
        for a in actions
    ]
    yield WrenchChange(
        2, "the moments of all loads have a wrong sign: x Fy + y Fx for x Fy - y Fx", tuple(signs)
    )


def joints_of(r: Result, link: str) -> list[str]:
    """Joints of a link whose force has a place."""
    return [name for name, joint in r.mechanism.joints.items() if link in joint.links]


def _mass_changes(r: Result, actions: list[Action]) -> Iterator[WrenchChange]:
    """Masses and moments of inertia ten times too large or small, or exchanged; g missing."""
    m = r.mechanism
    of_mass, of_inertia = dict[str, list[Action]](), dict[str, list[Action]]()
    for a in actions:
        if a.kind in ("weight", "inertia"):
            (of_mass if a.force.any() else of_inertia).setdefault(a.link, []).append(a)
    for words, some in (("mass", of_mass), ("moment of inertia", of_inertia)):
        for link, mine in some.items():
            for factor, text in FACTORS[:2]:
                yield WrenchChange(3, f"the {words} of {link} {text}", _times(mine, factor))
    weights = [a for a in actions if a.kind == "weight"]
    if weights:
        words = "masses in kg are mistaken for weights in N: g is missing"
        yield WrenchChange(2, words, _times(weights, 1 / m.g))
    for words, some, size in (
        ("masses", of_mass, {link: m.mass(link) for link in r.links}),
        ("moments of inertia", of_inertia, {link: float(np.max(m.inertia(link) or 0.0)) for link in r.links})
        if m.dimension == 2
        else ("", {}, {}),
    ):
        for one, two in combinations(some, 2):
            if size[one] and size[two] and not np.isclose(size[one], size[two], rtol=1e-9):
                both = (*_times(some[one], size[two] / size[one]), *_times(some[two], size[one] / size[two]))
                yield WrenchChange(3, f"the {words} of {one} and {two} are exchanged", both)


def _inertia_of_one(r: Result, actions: list[Action]) -> Iterator[WrenchChange]:
    """Only the inertia of one link counted."""
    inertia = [a for a in actions if a.kind == "inertia"]
    links = list(dict.fromkeys(a.link for a in inertia))
    for link in links if len(links) > 2 else ():
        others = [a for a in inertia if a.link != link]
        yield WrenchChange(2, f"only the inertia of {link} is counted", _times(others, 0.0))


def _across(v: Array) -> Array:
    return np.stack([-v[:, 1], v[:, 0]], axis=-1)


def _acceleration_changes(r: Result, link: str) -> Iterator[WrenchChange]:
    """The acceleration of a mass centre taken from another point, without a part, or with a wrong sign."""
    mass = r.mechanism.mass(link)
    a = r["point." + link + ".center.acceleration"]
    if not mass or not np.abs(a).max():
        return
    center, speed = r.center(link), r["angle." + link + ".speed"][:, None]
    turning = r["angle." + link + ".acceleration"][:, None]
    of_link = Action(link, "inertia", "", link, None, center, np.zeros_like(center), np.zeros(len(center)))

    def taken(order: int, words: str, new: Array) -> WrenchChange:
        sentence = f"the acceleration of the mass centre of {link} is taken {words}"
        return WrenchChange(order, sentence, (_force(of_link, -mass * (new - a)),))

    of_joints = {}
    for joint in joints_of(r, link):
        q = center - joint_place(r, joint)
        normal, tangential = -speed * speed * q, turning * _across(q)
        of_joints[joint] = a - normal - tangential
        yield taken(2, f"as that of {joint}", of_joints[joint])
        if np.abs(of_joints[joint]).max() > 1e-9 * np.abs(a).max():
            yield taken(2, f"without that of {joint}", a - of_joints[joint])
        if np.abs(q).max() > 1e-12:
            yield taken(2, f"without the normal part relative to {joint}", a - normal)
            yield taken(2, f"without the tangential part relative to {joint}", a - tangential)
    for one, two in combinations(of_joints, 2):
        yield taken(3, f"as the mean of {one} and {two}", (of_joints[one] + of_joints[two]) / 2)
    for k, axis in enumerate("xy"):
        sign = np.where(np.arange(2) == k, -1.0, 1.0)
        yield taken(2, f"with the wrong sign in {axis}", a * sign)
        yield taken(3, f"without its {axis} component", a * (sign + 1) / 2)
    if not np.abs(speed).max():
        yield from _of_slider(r, link, a, taken)


def _of_slider(
    r: Result, link: str, a: Array, taken: Callable[[int, str, Array], WrenchChange]
) -> Iterator[WrenchChange]:
    """The acceleration of what only slides, by the formulas of the slider-crank."""
    m = r.mechanism
    for drive in r.drives:
        joint = m.drives[drive].joint or drive
        crank = m.joints[joint].links[1] if joint in m.joints else ""
        if crank not in r.links or not r["angle." + crank + ".speed"].any():
            continue
        for pin in joints_of(r, crank):
            rods = [k for k in m.joints[pin].links if k != crank and k in r.links]
            ends = (
                [n for n in joints_of(r, rods[0]) if n != pin and link in m.joints[n].links] if rods else []
            )
            if pin == joint or not ends:
                continue
            arm = joint_place(r, pin) - joint_place(r, joint)
            size = np.hypot(*arm.T)[:, None]
            along = a / np.maximum(np.hypot(*a.T), 1e-300)[:, None]
            cosine = (arm * along).sum(axis=-1, keepdims=True) / size
            rod = joint_place(r, ends[0]) - joint_place(r, pin)
            ratio = np.hypot(*rod.T)[:, None] / size
            first = -along * r["angle." + crank + ".speed"][:, None] ** 2 * size
            outward = np.sign((rod * along).sum(axis=-1, keepdims=True))  # from the crank to the slider
            second = cosine + outward * (2 * cosine * cosine - 1) / ratio
            yield taken(3, "as r w^2 cos(theta)", first * cosine)
            yield taken(3, "as r w^2 (cos(theta) + cos(2 theta)/n)", first * second)


def _two_masses(r: Result, actions: list[Action], link: str) -> Iterator[WrenchChange]:
    """The mass of a link as two masses at its joints."""
    mine = [a for a in actions if a.link == link and a.kind == "inertia"]
    joints = joints_of(r, link)
    if len(joints) != 2 or not mine:
        return
    center, mass = r.center(link), r.mechanism.mass(link)
    speed, turning = r["angle." + link + ".speed"][:, None], r["angle." + link + ".acceleration"][:, None]
    places = [joint_place(r, joint) for joint in joints]
    line = places[1] - places[0]
    if not (line * line).sum(axis=-1).all():
        return
    a = r["point." + link + ".center.acceleration"]
    arms = [place - center for place in places]
    at = [a + turning * _across(q) - speed * speed * q for q in arms]
    share = (((center - places[0]) * line).sum(axis=-1) / (line * line).sum(axis=-1))[:, None]
    for words, part in (
        ("as two masses at its joints, without the correction couple", share),
        ("half and half at its joints", np.full_like(share, 0.5)),
    ):
        new = [
            replace(mine[0], at=place, force=-mass * weight * acceleration, couple=np.zeros(len(center)))
            for place, weight, acceleration in zip(places, (1 - part, part), at, strict=True)
        ]
        yield WrenchChange(3, f"the mass of {link} is taken {words}", (*_times(mine, 0.0), *new))


def _without_coriolis(r: Result) -> Iterator[WrenchChange]:
    """The angular acceleration of an arm that a block slides on, without the Coriolis acceleration."""
    m = r.mechanism
    for name, joint in m.joints.items():
        arm = joint.links[0]
        if not joint.slides or arm not in r.links or not m.inertia(arm) or name not in r.joints:
            continue
        pivots = [n for n in joints_of(r, arm) if "ground" in m.joints[n].links and m.joints[n].hinge]
        if not pivots:
            continue
        q = joint_place(r, name) - joint_place(r, pivots[0])
        speed, sliding = r["angle." + arm + ".speed"], r[f"slide.{name}.speed"]
        distance = np.hypot(*q.T)
        if not (distance.all() and (speed * sliding).any()):
            continue
        outward = np.sign((q * slide_direction(r, name)).sum(axis=-1))
        more = 2 * outward * sliding * speed / distance  # the acceleration is larger by this
        center = r.center(arm) - joint_place(r, pivots[0])
        like = Action(arm, "inertia", "", arm, None, r.center(arm), np.zeros_like(q), np.zeros(len(q)))
        force = -m.mass(arm) * more[:, None] * _across(center)
        words = f"the Coriolis acceleration in {name} is left out"
        yield WrenchChange(2, words, (_force(like, force), _couple(arm, -m.inertia(arm) * more)))
