"""Data of a problem as sentences: drives, links and loads, without computed values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any, get_args

import numpy as np

from dalembert.analysis.compile.contacts import coefficient, resting_coefficient
from dalembert.analysis.methods.applied_forces import actions
from dalembert.analysis.output.rounding import PART
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.model.joints.plane_joints import Joint
from dalembert.model.part import Part
from dalembert.model.quantities.values import Scalar
from dalembert.views.notation import Notation, Shown, load_sign


class AsGiven(Notation):
    """A notation that writes numbers with the figures of the file, up to six, and in the file's units: a unit scaled by
    a power of ten would reveal the size of the answer.

    >>> AsGiven().number(80.0), AsGiven().degrees(math.radians(60.0))
    ('80', '60')
    """

    scaled = False

    def number(self, value: float) -> str:
        """A number as text."""
        return self.given(value + 0.0) if math.isfinite(value) else "-"

    def degrees(self, angle: float) -> str:
        """An angle (rad) in degrees."""
        return self.number(0.0 if abs(angle) < PART else math.degrees(angle))


def as_stated(notation: Notation | None) -> AsGiven:
    """A notation with numbers as they were given."""
    return AsGiven(**vars(notation or Notation()))


def stated_numbers(part: Part, shown: Shown) -> list[str]:
    """The numbers that a part of the description states: 'stiffness 200 N/m', 'free length 0.1 m'."""
    out = []
    for name, field in type(part).model_fields.items():
        value = getattr(part, name)
        kind = next(_scalars((*field.metadata, field.annotation)), None)
        if kind is not None and isinstance(value, float) and value != field.default:
            out.append(f"{name.replace('_', ' ')} {shown.text(kind, value)}")
    return out


def _scalars(metadata: tuple[object, ...]) -> Iterator[str]:
    """Kinds of the numbers in a field, from its annotations."""
    for mark in metadata:
        if isinstance(mark, Scalar):
            yield mark.kind
        elif hasattr(mark, "__metadata__"):
            yield from _scalars(mark.__metadata__)
        else:
            yield from _scalars(get_args(mark))


def drive_text(shown: Shown, k: int, drive: str) -> str:
    """A drive's position, speed and acceleration, the latter two if given; an unknown position stays unknown."""
    r, kinds = shown.r, drive_kinds(shown.r, drive)
    described = r.mechanism.drives[drive]
    position = (
        "position unknown"
        if described.unknown
        else shown.text(kinds["position"], float(r.drive_position(drive)[k]))
    )
    rates = {"speed": r.drive_speed(drive), "acceleration": r.drive_acceleration(drive)}
    parts = [position, *(shown.text(kinds[n], float(v[k])) for n, v in rates.items() if v[k])]
    if described.effort is not None:
        parts.append(f"effort {shown.text(kinds['effort'], float(r.effort(drive)[k]))}")
    return ", ".join(parts)


def load_text(shown: Shown, k: int, name: str, written: str = "") -> str:
    """Given data of a load; a force or couple at position k, in ground axes, or as it is ``written`` in the file; of
    an unknown load, its place."""
    r = shown.r
    load: Any = r.mechanism.loads[name]
    if load.ON == "span":
        between = " and ".join(".".join(end) for end in load.between)
        return ", ".join([*stated_numbers(load, shown), f"between {between}"])
    if load.ON == "turn":
        return ", ".join([*stated_numbers(load, shown), f"in {load.joint}"])
    where = f" on {shown.heading(load.on)}{_spot(shown, getattr(load, 'at', None))}"
    if load.unknown:
        return f"unknown{_along(shown, load)}{where}"
    if written:
        return written + where
    a = next(a for a in actions(r) if a.of == name and a.kind == "load")
    force = load.ON == "point"
    return vector_text(shown, "force" if force else "moment", (a.force if force else a.couple)[k]) + where


def _spot(shown: Shown, at: str | Iterable[float] | None) -> str:
    if at is None:
        return ""
    return f" at {at}" if isinstance(at, str) else f" at ({place_text(shown, at)})"


def _along(shown: Shown, load: Any) -> str:
    """Positive direction of an unknown load."""
    direction = getattr(load, "direction", None)
    if direction is None:
        return ""
    if isinstance(direction, tuple):
        return f" along {_components(direction)}"
    return f" along {shown.text('angle', direction)}" + (" of its link" if load.axes == "link" else "")


def place_text(shown: Shown, p: Iterable[float]) -> str:
    """Coordinates in the reader's unit of length."""
    least = PART * shown.r.compiled.layout.length
    return ", ".join(shown.number("length", float(x), least) for x in p)


def vector_text(shown: Shown, kind: str, v: Array) -> str:
    """A force or couple in the reader's units: in the plane by magnitude and angle, in space by components."""
    if not np.isfinite(v).all():
        return "no value"
    if np.ndim(v) == 0:
        return shown.text(kind, float(v))
    if len(v) == 2:
        return shown.polar((float(v[0]), float(v[1])), kind)
    least = PART * float(np.abs(v).max())
    return f"({', '.join(shown.number(kind, float(x), least) for x in v)}) {shown.unit(kind)}"


def mass_text(shown: Shown, link: str, named: bool = False) -> str:
    """The mass of a link, or its weight where the file gives that."""
    m = shown.r.mechanism
    weight = m.links[link].weight
    if weight is None:
        return "mass " * named + shown.text("mass", m.mass(link))
    return f"weight {shown.text('force', weight)}"


def weights_text(shown: Shown) -> str:
    """Note on the divisor of weights, where a file gives weights and its g."""
    m = shown.r.mechanism
    divides = m.g_override is not None and any(link.weight is not None for link in m.links.values())
    return f"Weights are divided by g = {shown.text('acceleration', m.g)}" if divides else ""


def joint_text(shown: Shown, joint: str) -> str:
    """Data of a joint besides its points: ', pitch radii 80 mm and 40 mm; μ = 0.4, R = 0.07 m'."""
    described = shown.r.mechanism.joints[joint]
    return joint_measures(shown, described) + _friction(shown, described)


def joint_measures(shown: Shown, joint: Any) -> str:
    """Radii, directions and angles of a joint: ', pitch radii 80 mm and 40 mm, pressure angle 20°'."""
    parts = []
    if joint.wheels == 2:
        both = " and ".join(shown.text("length", float(x)) for x in joint.pitch_radii)
        parts.append(f"{'pitch ' if joint.TOOTHED else ''}radii {both}")
        parts.append("internal" if joint.internal else "")
    for key, words, kind in OWN_MEASURES:
        value = getattr(joint, key, None)
        parts.append(
            f"{words} {shown.text(kind, float(value))}" if isinstance(value, float) and value else ""
        )
    return "".join(f", {part}" for part in parts if part)


def axes_text(joint: Any) -> str:
    """The axes of a joint in space, in link axes: ', axis (0, 0, 1)'."""
    parts = [f"axis {_components(joint.axis)}"] if getattr(joint, "axis", None) else []
    frames = getattr(joint, "axes", None)
    for link, frame in zip(joint.links, (frames.i, frames.j), strict=True) if frames else ():
        axes = [f"{e} {_components(v)}" for e, v in (("x", frame.x), ("z", frame.z)) if v]
        parts += [f"on {link} {', '.join(axes)}"] if axes else []
    return "".join(f", {part}" for part in parts)


def _components(v: Iterable[float]) -> str:
    return f"({', '.join(f'{x:.6g}' for x in v)})"


OWN_MEASURES = (
    ("radius", "radius", "length"),
    ("direction", "along", "angle"),
    ("pressure_angle", "pressure angle", "angle"),
    ("helix_angle", "helix angle", "angle"),
    ("lead", "lead", "length"),
)
"""Keys of joints, with their names and kinds."""


def _friction(shown: Shown, joint: Joint) -> str:
    """The friction of a joint as given: '; μ = 0.4, R = 0.07 m'."""
    r, f, as_written = shown.r, getattr(joint, "friction", None), shown.notation.given
    efficiency = getattr(joint, "efficiency", None)
    if efficiency is not None and r.friction is not None:
        return f"; η = {as_written(efficiency)}"
    if f is None or r.friction is None:
        return ""
    mu, still = coefficient(r.mechanism, joint), resting_coefficient(r.mechanism, joint)
    parts = [f"μ = {as_written(mu)}", f"at rest {as_written(still)}" if still != mu else ""]
    for key, sign in (("radius", "R"), ("half_height", "half height"), ("arm", "arm")):
        value = getattr(f, key, None)
        parts.append(f"{sign} = {shown.text('length', value)}" if value else "")
    if getattr(f, "force", None):
        parts.append(f"constant {shown.text('force', f.force)}")
    if getattr(f, "guide", None):
        behind, ahead = (shown.text("length", x) for x in f.guide)
        parts.append(f"guide {behind} behind and {ahead} ahead")
    return f"; {', '.join(p for p in parts if p)}"


def stated_lines(shown: Shown, k: int) -> list[str]:
    """All given data except the drives, one line per part: links, joints, loads."""
    r, m = shown.r, shown.r.mechanism
    lines = []
    for link in (*r.links, GROUND):
        points = [f"{n} ({place_text(shown, p)})" for n, p in m.points(link).items()]
        if link != GROUND and m.mass(link):
            points += [f"{mass_text(shown, link, True)}, centre ({place_text(shown, m.center(link))})"]
            if m.dimension == 2 and m.inertia(link):
                points += [f"inertia {shown.text('inertia', m.inertia(link))}"]
        if points:
            lines.append(
                f"{shown.heading(link)}, local axes, in {shown.unit('length')}: {'; '.join(points)}."
            )
    for name, joint in m.joints.items():
        details = joint_text(shown, name) + axes_text(joint)
        lines += [f"Joint {name}: {joint.type.replace('_', ' ')}{details}."] if details else []
    lines += [f"{load_sign(name)}: {load_text(shown, k, name)}." for name in m.loads]
    lines += [f"{weights_text(shown)}."] if weights_text(shown) else []
    if any(m.gravity_vector):
        lines.append(f"Gravity {vector_text(shown, 'acceleration', np.array(m.gravity_vector))}.")
    return lines
