"""Checks that the names in a description exist, and that its parts fit together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.model.drives.turning_checks import turning_problems
from dalembert.model.joints.joint_part import JointPart
from dalembert.model.joints.turn_loads import TurnLoad
from dalembert.model.links.link import CENTER, GROUND, Link, Offset
from dalembert.model.load_types import Couple, ForceLoad, SpanLoad
from dalembert.model.quantities.coordinates import SPEED, TIME, along_of, parts
from dalembert.model.quantities.expression_trees import ARGUMENTS
from dalembert.model.quantities.expressions import CONSTANTS, Expression
from dalembert.model.quantities.tables import UNITS, Table
from dalembert.model.quantities.varying import Varying
from dalembert.model.space_checks import assembly_problems, space_problems
from dalembert.units import KINDS
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.model.description import Mechanism
    from dalembert.model.drives.drives import Drive


def problems(m: Mechanism) -> list[ModelError]:
    """Everything that does not fit, in the order of the file."""
    checks = (_links, _joints, _drives, _loads, _assembly, space_problems, turning_problems, _answers)
    return [problem for check in checks for problem in check(m)]


def _links(m: Mechanism) -> Iterator[ModelError]:
    if not set(m.links) - {GROUND}:
        yield ModelError(
            "the mechanism has no moving link", "write links: {crank: {points: {...}}, ...}", ("links",)
        )
    ground = m.links.get(GROUND)
    if ground is not None and (
        ground.mass or ground.weight or ground.inertia or ground.center or ground.shape
    ):
        yield ModelError("the fixed link 'ground' has mass properties", "leave them out", ("links", GROUND))
    for name, link in m.links.items():
        for path, size in _sizes(link):
            if size != m.dimension:
                yield _wrong_size(m, f"a vector of link {name!r}", size, ("links", name, *path))


def _sizes(link: Link) -> Iterator[tuple[tuple[str, ...], int]]:
    for point, place in link.points.items():
        at = place.at if isinstance(place, Offset) else place
        if at:
            yield ("points", point), len(at)
    if link.center is not None:
        yield ("center",), len(link.center)
    if isinstance(link.inertia, tuple):
        yield ("inertia",), 3


def _wrong_size(m: Mechanism, what: str, size: int, path: tuple[str, ...]) -> ModelError:
    wrong = f"{what} has {size} components, and {m.dimension} are needed in {_where(m)}"
    return ModelError(wrong, "write [x, y]" if m.dimension == 2 else "write [x, y, z]", path)


def _where(m: Mechanism) -> str:
    return "the plane" if m.dimension == 2 else "space"


def _link(m: Mechanism, link: str, user: str, path: tuple[str | int, ...]) -> Iterator[ModelError]:
    if link in m.links:
        return
    if link == GROUND:
        yield ModelError(
            f"{user} needs the fixed link 'ground', which is missing",
            "add ground: {points: {...}} to links",
            path,
        )
    else:
        yield ModelError(
            f"{user} names the link {link!r}, which does not exist", closest(link, list(m.links)), path
        )


def _point(
    m: Mechanism, link: str, point: str, user: str, path: tuple[str | int, ...]
) -> Iterator[ModelError]:
    errors = list(_link(m, link, user, path))
    yield from errors
    if not errors and point != CENTER and point not in m.links[link].points:
        points = list(m.links[link].points)
        yield ModelError(
            f"{user} needs a point {point!r} of link {link!r}, which has {', '.join(points) or 'none'}",
            _point_remedy(point, points, path),
            path,
        )


def _point_remedy(point: str, points: list[str], path: tuple[str | int, ...]) -> str:
    guess = closest(point, points)
    if guess.startswith("did"):
        return guess
    of_joint = path[0] == "joints" and path[2:] in ((), ("at",), ("at", 0), ("at", 1))
    return f"add the point {point}, or name {'others with at: [of i, of j]' if of_joint else 'another'}"


def _joints(m: Mechanism) -> Iterator[ModelError]:
    for name, joint in m.joints.items():
        user, path = f"joint {name!r}", ("joints", name)
        for link, point, to_link, to_point in joint.places(name):
            missing = list(_link(m, link, user, (*path, *to_link)))
            yield from missing or _point(m, link, point, user, (*path, *to_point))
        if m.dimension not in joint.DIMENSIONS:
            yield ModelError(
                f"{user} is of the type {joint.type!r}, which is not for {_where(m)}",
                "use a planar joint, or write space: space" if m.dimension == 2 else "take a joint in space",
                (*path, "type"),
            )
        yield from _friction(m, name, joint)


def _friction(m: Mechanism, name: str, joint: JointPart) -> Iterator[ModelError]:
    for friction, path in joint.frictions():
        if getattr(friction, "force", None) is not None:
            continue
        if friction.coefficient is None and m.friction.coefficient is None:
            yield ModelError(
                f"the friction of joint {name!r} has no coefficient",
                "give it one, or a top-level friction: {coefficient: 0.1}",
                ("joints", name, *path),
            )


def _drives(m: Mechanism) -> Iterator[ModelError]:
    taken: dict[tuple[str, str | None], str] = {}
    for name in m.start.keys() - m.drives.keys():
        yield ModelError(
            f"start names the drive {name!r}, which does not exist",
            closest(name, list(m.drives)) if m.drives else f"write drives: {{{name}: {{effort: 0}}}}",
            ("start", name),
        )
    for name, drive in m.drives.items():
        joint, path = drive.joint or name, ("drives", name)
        yield from _word(name, joint, path)
        if joint not in m.joints:
            at = (*path, "joint") if drive.joint else path
            yield ModelError(
                f"drive {name!r} drives the joint {joint!r}, which does not exist",
                closest(joint, list(m.joints)),
                at,
            )
            continue
        yield from _freedom(name, drive.freedom, joint, m.joints[joint])
        yield from _axis(name, drive, joint, m.joints[joint])
        if drive.position is None and drive.law is None and name not in m.start:
            yield ModelError(
                f"drive {name!r} has {'a motor' if drive.motor else 'an effort'} and no start",
                f"write start: {{{name}: {{position: {'60 deg' if drive.turns else '0 mm'}, speed: 0}}}}, "
                "or its position",
                path,
            )
        other = taken.setdefault((joint, drive.freedom), name)
        if other != name:
            yield ModelError(
                f"drives {other!r} and {name!r} prescribe the same freedom of joint {joint!r}",
                "leave one of them out",
                path,
            )
        if drive.effort is not None:
            yield from _varying(m, drive.effort, f"the effort of drive {name!r}", (*path, "effort"))


def _word(name: str, joint: str, path: tuple[str, ...]) -> Iterator[ModelError]:
    """A drive whose name means something else where expressions are read."""
    what = "constant" if name in CONSTANTS else "function" if name in ARGUMENTS else ""
    if what:
        yield ModelError(
            f"drive {name!r} has the name of a {what} that expressions know",
            f"give it another name, with its joint beside it: drive_{name}: {{joint: {joint}, ...}}",
            path,
        )


def _freedom(name: str, freedom: str | None, joint: str, part: JointPart) -> Iterator[ModelError]:
    choices = part.freedoms
    if not choices:
        yield ModelError(
            f"drive {name!r} drives joint {joint!r}, a {part.type} without a freedom to prescribe",
            "drive another joint",
            ("drives", name),
        )
    elif freedom not in choices:
        yield ModelError(
            f"drive {name!r} prescribes a {freedom}, and the freedom of joint {joint!r}, a {part.type}, "
            f"is {' or '.join(choices)}",
            f"write freedom: {choices[0]}, with its units",
            ("drives", name, "freedom"),
        )


def _axis(name: str, drive: Drive, joint: str, part: JointPart) -> Iterator[ModelError]:
    """Checks the axis of a drive: a ball turns about the axis that its drive gives; other joints have an axis."""
    ball = part.ball and drive.freedom == "turn"
    if ball and drive.axis is None:
        yield ModelError(
            f"drive {name!r} turns joint {joint!r}, a {part.type} joint, which can turn about any axis",
            f"write axis: [0, 0, 1], in the axes of {part.links[0]}",
            ("drives", name),
        )
    elif drive.axis is not None and not ball:
        yield ModelError(
            f"drive {name!r} has an axis, but joint {joint!r}, a {part.type} joint, defines its axis itself",
            "leave it out",
            ("drives", name, "axis"),
        )


def _varying(m: Mechanism, value: Varying, what: str, path: tuple[str | int, ...]) -> Iterator[ModelError]:
    if isinstance(value, (int, float)):
        return
    drives = list(m.drives)
    for name in sorted(value.numbers & set(drives) if isinstance(value, Expression) else ()):
        yield ModelError(
            f"{what} has the number {name} in its expression, but {name!r} is also the name of a drive",
            "give the drive a name that is a word",
            path,
        )
    for name in sorted(value.names - set(drives)):
        yield from _coordinate(m, name, what, path)
    drive_kinds = {name: "turn" if drive.turns else "slide" for name, drive in m.drives.items()}
    along = along_of(value.against, drive_kinds) if isinstance(value, Table) else ""
    if isinstance(value, Table) and along and along != value.along:
        one = {kind: KINDS[kind].phrase for kind in UNITS}
        is_drive = value.against in m.drives
        yield ModelError(
            f"{what} is a table whose x are {value.along.replace('_', ' ')}s, and "
            f"{'the position of drive ' if is_drive else ''}{value.against!r} is {one[along]}",
            "give x with units of that kind",
            (*path, "x"),
        )


def _coordinate(m: Mechanism, name: str, what: str, path: tuple[str | int, ...]) -> Iterator[ModelError]:
    """Checks a name that is not a drive: it must be time, or an existing coordinate."""
    coordinate, of = parts(name), name.removesuffix(SPEED)
    if of in m.drives:
        return
    if coordinate is None and name != TIME:
        remedy = _drive_remedy(name, list(m.drives))
        yield ModelError(f"{what} uses {name!r}, which is not a drive", remedy, path)
    elif path[0] == "drives" and coordinate:
        remedy = "an effort depends on drives, their speeds and time: write it as a load, or against a drive"
        yield ModelError(f"{what} uses {name!r}", remedy, path)
    elif coordinate is None:
        moved = (x is not None for d in m.drives.values() for x in (d.law, d.motor, d.effort))
        if not m.start and not any(moved) and not any(d.moves for d in m.drives.values()):
            remedy = "give a drive a constant speed or a law, or use its position instead of time"
            yield ModelError(
                f"{what} depends on time, but no drive has a law of motion or a speed", remedy, path
            )
    elif coordinate[0] == "links":
        if coordinate[1] == GROUND or m.dimension == 3:
            why = (
                "which does not turn" if coordinate[1] == GROUND else "which in space is not a single number"
            )
            yield ModelError(f"{what} uses {name!r}, {why}", "write joints.NAME.turn", path)
        yield from _link(m, coordinate[1], what, path)
    elif coordinate[1] not in m.joints:
        remedy = closest(coordinate[1], list(m.joints))
        yield ModelError(f"{what} uses the joint {coordinate[1]!r}, which does not exist", remedy, path)
    elif coordinate[2] not in m.joints[coordinate[1]].freedoms:
        freedoms = " or ".join(m.joints[coordinate[1]].freedoms) or "none"
        yield ModelError(
            f"{what} uses {name!r}, and the freedoms of that joint are {freedoms}", "name one", path
        )
    elif m.joints[coordinate[1]].ball:
        yield ModelError(
            f"{what} uses {name!r}, of a joint that can turn about any axis",
            "drive it, and name the drive",
            path,
        )


def _drive_remedy(name: str, drives: list[str]) -> str:
    if name.startswith("links.") and name.endswith(SPEED):
        return f"the speed of an angle is angle.{name.split('.')[1]}.speed"
    guess = closest(name, [*drives, "unknown"])
    if guess.startswith("did"):
        return guess
    return closest(name, drives) if drives else "give a number: the file has no drives"


def _loads(m: Mechanism) -> Iterator[ModelError]:
    for name, load in m.loads.items():
        user, path = f"load {name!r}", ("loads", name)
        if isinstance(load, (ForceLoad, Couple)) and isinstance(load.at, str):
            missing = list(_link(m, load.on, user, (*path, "on")))
            yield from missing or _point(m, load.on, load.at, user, (*path, "at"))
        elif isinstance(load, (ForceLoad, Couple)):
            yield from _link(m, load.on, user, (*path, "on"))
        elif isinstance(load, SpanLoad):
            for k, (link, point) in enumerate(load.between):
                yield from _point(m, link, point, user, (*path, "between", k))
        if isinstance(load, (ForceLoad, Couple)):
            yield from _components(m, load, user, path)
        if isinstance(load, TurnLoad):
            yield from _torsion(m, load, user, path)


def _components(
    m: Mechanism, load: ForceLoad | Couple, user: str, path: tuple[str, ...]
) -> Iterator[ModelError]:
    for value in load.varying:
        yield from _varying(m, value, user, (*path, "value"))
    vectors: dict[str, object] = {
        "value": load.value,
        "at": getattr(load, "at", None),
        "direction": getattr(load, "direction", None),
    }
    if isinstance(load, Couple) and load.components is None and (m.dimension == 3) != bool(load.direction):
        yield ModelError(
            f"{user} needs a direction in space"
            if m.dimension == 3
            else f"{user} has a direction in the plane",
            "write direction: [0, 0, 1], or value: [x, y, z]" if m.dimension == 3 else "leave it out",
            path,
        )
    if isinstance(load, ForceLoad) and isinstance(load.direction, float) and m.dimension == 3:
        yield ModelError(
            f"the direction of {user} is an angle, which is for the plane",
            "write direction: [x, y, z]",
            (*path, "direction"),
        )
    for key, vector in vectors.items():
        if isinstance(vector, tuple) and len(vector) != m.dimension:
            yield _wrong_size(m, f"the {key} of {user}", len(vector), (*path, key))


def _torsion(m: Mechanism, load: TurnLoad, user: str, path: tuple[str, ...]) -> Iterator[ModelError]:
    name, at = load.joint, (*path, "joint")
    if name not in m.joints:
        yield ModelError(
            f"{user} names the joint {name!r}, which does not exist", closest(name, list(m.joints)), at
        )
        return
    joint = m.joints[name]
    turns = [freedom for freedom in joint.freedoms if freedom.startswith("turn")]
    what = f"{user} is in joint {name!r}, a {joint.type}" + (" joint" if m.dimension == 3 else "")
    if not turns:
        yield ModelError(f"{what}, which does not turn", "name a joint that turns", at)
    elif joint.ball and not any(d.axis and m.drive_joint(n) == name for n, d in m.drives.items()):
        yield ModelError(
            f"{what}, which can turn about any axis",
            "name a joint that turns about one axis, or give couples",
            at,
        )
    elif joint.turn_of(load.freedom) is None:
        hint = f", which has no {load.freedom}" if load.freedom else f", which has {len(turns)} turns"
        yield ModelError(
            f"{what}{hint}",
            f"write freedom: {' or '.join(turns)}",
            (*path, *(["freedom"] if load.freedom else [])),
        )


def _assembly(m: Mechanism) -> Iterator[ModelError]:
    for link in m.assembly:
        path = ("assembly", link)
        if link == GROUND:
            yield ModelError("assembly gives a pose of 'ground', which does not move", "leave it out", path)
        elif link not in m.links:
            yield ModelError(
                f"assembly names the link {link!r}, which does not exist", closest(link, list(m.links)), path
            )
    yield from assembly_problems(m)


def _answers(m: Mechanism) -> Iterator[ModelError]:
    points = [f"{link}.{point}" for link, part in m.links.items() for point in (*part.points, CENTER)]
    known = list(dict.fromkeys([*m.links, *m.joints, *m.drives, *m.loads]))
    for k, answer in enumerate(m.answers):
        if answer.of is not None and answer.of not in known and answer.of not in points:
            yield ModelError(
                f"answer {k + 1} is of {answer.of!r}, which is not a link, joint, drive, load or link.point",
                closest(answer.of, points if "." in answer.of else known),
                ("answers", k, "of"),
            )
        for key in ("on", "by"):
            link = getattr(answer, key)
            if link is not None:
                yield from _link(m, link, f"answer {k + 1}", ("answers", k, key))
