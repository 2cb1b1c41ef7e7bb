"""Problems with one wrong datum each: loads, rates, masses, friction, g; the geometry is kept.

Nearly all are changes of the compiled numbers, so that the description is not read or checked again.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.arrays import Array, Flags, Tree
from dalembert.unit_names import unit
from dalembert.units import file_units

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.result import Result
    from dalembert.core.friction.contact_equations import Contacts

Change = Tree | Callable[["Compiled"], "Compiled"]
"""Values by their paths in the model file, or what becomes of the compiled numbers."""

Mistake = tuple[str, Change]
"""A mistake in words, and what it does."""

STANDARD = 9.80665


def change_numbers(part: str, **new: Callable[[Array], Array]) -> Change:
    """Arrays of a part of the compiled mechanism replaced, each by a function of what it was."""
    return partial(_replace, part.split("."), new)


def _replace(path: Sequence[str], new: dict[str, Callable[[Array], Array]], record: Any) -> Any:
    if not path:
        return replace(record, **{name: f(getattr(record, name)) for name, f in new.items()})
    return replace(record, **{path[0]: _replace(path[1:], new, getattr(record, path[0]))})


def times(factor: Array | float) -> Callable[[Array], Array]:
    """A function that multiplies."""
    return lambda a: np.asarray(a * factor)


def with_row(k: Any, row: Array) -> Callable[[Array], Array]:
    """A function that puts another row in the place of one."""

    def put(a: Array) -> Array:
        out = np.array(a)
        out[k] = row
        return out

    return put


def changes(r: Result) -> Iterator[Mistake]:
    """Data changed one at a time: a sentence and what to put in their place."""
    yield from _friction_changes(r)
    m = r.mechanism
    if not any(m.gravity_vector):
        pull = [*[0.0] * (m.dimension - 1), -STANDARD]
        gravity = change_numbers("forcing.inertia", gravity=lambda _: np.array(pull))
        yield "gravity is counted, and the problem has none", gravity
    known = [name for name, load in m.loads_on("point").items() if not load.unknown]
    for k, name in enumerate(known):
        yield from _force_changes(r, k, name)
    for k, drive in enumerate(r.drives):
        yield from _rate_changes(r, k, drive)
    for k, link in enumerate(r.links):
        yield from _link_changes(r, k, link)
    yield from _gravity_changes(r)


def _rate_changes(r: Result, k: int, drive: str) -> Iterator[Mistake]:
    """The speed and acceleration of a drive."""

    def scaled(name: str, factor: float) -> Change:
        return change_numbers(
            "schedule", **{name: lambda a: a * np.where(np.arange(a.shape[1]) == k, factor, 1.0)}
        )

    if r.drive_acceleration(drive).any():
        yield f"the acceleration of drive {drive} is left out", scaled("acceleration", 0.0)
        yield f"the acceleration of drive {drive} has the wrong sense", scaled("acceleration", -1.0)
    if r.drive_speed(drive).any():
        for factor, words in (
            (30 / math.pi, "rad/s mistaken for rpm"),
            (math.pi / 30, "rpm mistaken for rad/s"),
            (0.5 / math.pi, "rpm only divided by 60, revolutions per second mistaken for rad/s"),
        ):
            yield f"the speed of drive {drive}: {words}", scaled("speed", factor)
        yield f"the speed of drive {drive} is left out", scaled("speed", 0.0)


def _force_changes(r: Result, k: int, name: str) -> Iterator[Mistake]:
    """A force at another point of its link, or in another direction."""
    m, load = r.mechanism, r.mechanism.loads[name]
    on = load.on  # type: ignore[union-attr]
    base = r.compiled.layout.reference[int(r.compiled.forcing.forces.link[k])]
    for point in [*m.points(on), "center"]:
        if point != load.at:  # type: ignore[union-attr]
            moved = with_row(k, np.subtract(m.point(on, point), base))
            change = change_numbers("forcing.forces", at=moved)
            yield f"the moment arm of {name} is wrong: the load is applied at {point}", change
    other = "link" if load.axes == "ground" else "ground"  # type: ignore[union-attr]
    turned = change_numbers("forcing.forces", follows=lambda a: a ^ (np.arange(len(a)) == k))
    yield f"the direction of {name} is counted in {other} axes", turned
    if m.dimension == 2:
        x, y = (r.compiled.forcing.forces.value[:, k, c] for c in (0, 1))
        slips = {"from the other axis": (y, x), "clockwise": (x, -y), "from the negative x axis": (-x, y)}
        for slip, both in slips.items():
            value = with_row((slice(None), k), np.stack(both, axis=-1))
            yield f"the angle of {name} is counted {slip}", change_numbers("forcing.forces", value=value)


def _link_changes(r: Result, k: int, link: str) -> Iterator[Mistake]:
    """The mass centre or the moment of inertia of a link at the wrong point."""
    m = r.mechanism
    if not m.mass(link):
        return
    plane, base = m.dimension == 2, r.compiled.layout.reference[k]
    center = np.array(m.center(link))
    points = {n: np.array(p) for n, p in m.points(link).items()}

    def centered(at: Array) -> Change:
        return change_numbers("forcing.inertia", center=with_row(k, at - base))

    for name, p in points.items() if plane else ():
        about = with_row(k, m.inertia(link) + m.mass(link) * float(magnitude(p - center)) ** 2)
        words = f"the moment of inertia of {link} is taken about {name}, not its mass centre"
        yield words, change_numbers("forcing.inertia", inertia=about)
    for name, p in points.items():
        yield f"the mass centre of {link} is placed at {name}", centered(p)
    if center[1] and plane:
        yield f"the mass centre of {link} is on the wrong side of it", centered(center * [1, -1])
        along = np.array([float(magnitude(center)), 0.0])
        yield f"the angle of the mass centre of {link} is left out", centered(along)


BOOKS_G = {
    "m": {9.81: "9.81 m/s^2", 9.8: "9.8 m/s^2", 10.0: "10 m/s^2"},
    "ft": {
        32.2 * 0.3048: "32.2 ft/s^2",
        32.0 * 0.3048: "32 ft/s^2",
        386.0 * 0.0254: "386 in/s^2",
        386.4 * 0.0254: "386.4 in/s^2",
    },
}
"""The g of books in m/s2, with its text: where lengths are metres, and where they are feet or inches."""


def _gravity_changes(r: Result) -> Iterator[Mistake]:
    """The book's g for the file's, where weights or masses make it count."""
    m = r.mechanism
    pull = np.array(m.gravity_vector)
    in_file = float(magnitude(pull)) or m.g
    weighed = any(m.links[link].weight is not None for link in r.links)
    system = "ft" if file_units(m.units).text("length") in ("ft", "in") else "m"
    for g, text in BOOKS_G[system].items() if weighed or pull.any() else ():
        if not 1e-9 < abs(g / in_file - 1) < 0.05:
            continue
        change: Tree = {"g": g} if weighed else {}
        if pull.any():
            change["gravity"] = (pull * g / in_file).tolist()
        of_book = text.partition(" ")[2]
        yield f"g is taken as {text}, not {unit(of_book).of_si(in_file):.6g} {of_book}", change


# friction


def _friction_changes(r: Result) -> Iterator[Mistake]:
    """Friction left out, turned round, or with another circle, radius or coefficient: everywhere, then at one joint."""
    contacts = r.compiled.contacts
    if contacts is None or not contacts.coefficient[~contacts.fixed].any():
        return
    rough = ~contacts.fixed
    circles = rough & np.isin(contacts.kind, ("pin", "ball"))
    yield "friction is left out", _friction(rough, coefficient=0.0)
    for words, where in (
        ("mu R, not R sin(phi)", contacts.circle & circles),
        ("R sin(phi), not mu R", ~contacts.circle & circles),
    ):
        if where.any():
            circle = change_numbers("contacts", circle=lambda a, w=where: a ^ w)  # type: ignore[misc]
            yield f"the radius of the friction circles is taken as {words}", circle
    if (contacts.coefficient != contacts.resting)[rough].any():
        mu = np.where(rough, contacts.resting, contacts.coefficient)
        resting = change_numbers("contacts", coefficient=lambda _: mu)
        yield "the coefficient at rest is mistaken for that of motion", resting
    joints = dict.fromkeys(contacts.joint[rough].tolist())
    yield from _exchanged_friction(r, contacts, rough, list(joints))
    by_joint = {f" of joint {r.joints[k]}": contacts.joint == k for k in joints} if len(joints) > 1 else {}
    for words, here in ({"": rough} | by_joint).items():
        some, round_ = rough & here, circles & here
        if words:
            yield f"the friction{words} is left out", _friction(some, coefficient=0.0)
        all_of = f"the friction{words}" if words else "all friction"
        yield f"{all_of} acts in the wrong sense, with the motion", _friction(some, coefficient=-1.0)
        if round_.any():
            pins = words or " of the pins"
            yield f"the diameter{pins} is mistaken for the radius", _friction(round_, lever=2.0)
            yield f"the radius{pins} is mistaken for the diameter", _friction(round_, lever=0.5)


def _exchanged_friction(r: Result, contacts: Contacts, rough: Flags, joints: list[int]) -> Iterator[Mistake]:
    """Coefficients and radii of two joints exchanged, or the friction of both in the wrong sense."""
    mu, lever = contacts.coefficient, contacts.lever
    for a, b in combinations(joints, 2):
        one, two = (rough & (contacts.joint == k) for k in (a, b))
        names = r.joints[a], r.joints[b]
        for here, other, (name, of) in ((one, two, names), (two, one, names[::-1])):
            if not np.isclose(mu[here][0], mu[other][0], rtol=1e-9):
                words = f"the coefficient of friction of {name} is taken as that of {of}"
                yield words, change_numbers("contacts", coefficient=_put(here, mu[other][0]))
        if contacts.kind[int(np.argmax(one))] == contacts.kind[int(np.argmax(two))] == "pin":
            swapped = np.where(one, lever[two][0], np.where(two, lever[one][0], lever))
            if not np.allclose(swapped, lever, rtol=1e-9):
                words = f"the radii of {names[0]} and {names[1]} are exchanged"
                yield words, change_numbers("contacts", lever=lambda _, new=swapped: new)  # type: ignore[misc]
        words = f"the friction of joints {names[0]} and {names[1]} acts in the wrong sense"
        yield words, _friction(one | two, coefficient=-1.0)


def _put(where: Flags, value: float) -> Callable[[Array], Array]:
    """A function that puts a value in some places."""
    return lambda a: np.where(where, value, a)


def _friction(where: Flags, coefficient: float = 1.0, lever: float = 1.0) -> Change:
    """Coefficients or levers of some contacts times a factor."""
    mu, arm = (times(np.where(where, factor, 1.0)) for factor in (coefficient, lever))
    return change_numbers("contacts", coefficient=mu, resting=mu, lever=arm)
