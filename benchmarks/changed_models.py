"""Models of this repository, changed at random in ways that most often still describe a machine.

Numbers are scaled, taken away or with another sign, keys come from other files, joints and loads are doubled, springs,
friction and loads with expressions are put in, and drives go to the places where mechanisms are at their worst.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable, Iterator
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import Any

from dalembert.bundled import cases, examples
from dalembert.errors import DalembertError
from dalembert.model.files.model_files import read_file

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.laws.mutations import get, paths, put  # noqa: E402

FOLDERS = ("src/dalembert/model/library/files", "tests/elements", "tests/machine", "tests/friction")
Tree = dict[str, Any]

FACTORS = (0.0, -1.0, 0.5, 2.0, 1.01, 0.9, 1.3, 1e-3, 1e3)
POSITIONS: tuple[Any, ...] = (
    *("0 deg", "90 deg", "180 deg", "270 deg", "30 deg", "-45 deg", 1.0, 0.0),
    {"from": "0 deg", "to": "360 deg", "count": 5},
    {"from": "80 deg", "to": "100 deg", "count": 3},
    {"from": "360 deg", "to": "0 deg", "count": 4},
    ["10 deg", "70 deg", "20 deg"],
)
LAWS = (
    "sin({0})",
    "10*cos(2*{0})",
    "abs({0})",
    "-5*{0}",
    "max(0, {0})",
    "sign({0} - 0.3)",
    "-3*max(0, sign(sin(2*{0})))",
    "{0}.speed",
    "-3*{0}.speed**2",
)


@cache
def sources() -> dict[str, Tree]:
    """Every model file that reads as one: where it is -> its tree."""
    files = [*examples().values(), *cases().values()]
    files += [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.yaml"))]
    out = {}
    for path in files:
        try:
            tree = read_file(path)[0]
        except DalembertError:
            continue
        for name, one in _models(tree):
            out[f"{path.relative_to(ROOT).as_posix()}{name}"] = one
    return out


def _models(tree: Any) -> Iterator[tuple[str, Tree]]:
    """The model of a file, or the models that it lists."""
    if not isinstance(tree, dict):
        return
    if "links" in tree:
        yield "", tree
        return
    for key, value in tree.items():
        if isinstance(value, dict) and "links" in value:
            yield f":{key}", value


def changed_model(rng: random.Random) -> tuple[str, Tree]:
    """A file's name and its tree with up to four changes."""
    name = rng.choice(sorted(sources()))
    tree = deepcopy(sources()[name])
    for _ in range(rng.choice((0, 1, 1, 1, 2, 2, 3, 4))):
        way = rng.choice(WAYS)
        try:
            way(tree, rng)
        except (KeyError, IndexError, TypeError, AttributeError, ValueError):
            continue  # what it changes is not in this file
    return name, tree


def _number(tree: Tree, rng: random.Random) -> None:
    places = [p for p in paths(tree) if p[0] != "answers" and type(get(tree, p)) in (int, float)]
    path = rng.choice(places)
    factor = rng.choice((*FACTORS, rng.uniform(0.5, 1.5), rng.uniform(0.5, 1.5)))
    put(tree, path, get(tree, path) * factor)


def _text_number(tree: Tree, rng: random.Random) -> None:
    """A number with its unit."""
    places = [p for p in paths(tree) if p[0] != "answers" and isinstance(get(tree, p), str)]
    rng.shuffle(places)
    for path in places:
        first, blank, rest = get(tree, path).partition(" ")
        try:
            value = float(first)
        except ValueError:
            continue
        if math.isfinite(value):
            put(tree, path, f"{value * rng.choice(FACTORS):.6g}{blank}{rest}")
            return


def _point(tree: Tree, rng: random.Random) -> None:
    """A point goes to where another one is, or beside its place."""
    link = rng.choice(list(tree["links"].values()))
    name, other = rng.choice(list(link["points"])), rng.choice(list(link["points"]))
    at = link["points"][other]
    link["points"][name] = [x * rng.choice((1, 1, 1.02, 0.98, 1.2)) for x in at]


def _graft(tree: Tree, rng: random.Random) -> None:
    """A key of a part from a part of the same kind, of any file."""
    group = rng.choice(("links", "joints", "joints", "loads", "loads", "drives"))
    part = rng.choice(list(tree[group].values()))
    other = sources()[rng.choice(sorted(sources()))]
    donors = [d for d in other.get(group, {}).values() if d.get("type") == part.get("type") and d]
    donor = rng.choice(donors)
    key = rng.choice([k for k in donor if k not in ("type", "links", "points")])
    part[key] = deepcopy(donor[key])


def _top(tree: Tree, rng: random.Random) -> None:
    """A key beside the links from another file."""
    other = sources()[rng.choice(sorted(sources()))]
    key = rng.choice([k for k in other if k not in ("links", "joints", "answers", "title")])
    value = deepcopy(other[key])
    tree[key] = value | tree[key] if isinstance(value, dict) and isinstance(tree.get(key), dict) else value


def _removed(tree: Tree, rng: random.Random) -> None:
    path = rng.choice([p for p in paths(tree) if len(p) > 1 and p[0] != "answers"])
    del get(tree, path[:-1])[path[-1]]


def _friction(tree: Tree, rng: random.Random) -> None:
    tree["friction"] = {"coefficient": rng.choice((0.0, 0.05, 0.1, 0.3, 0.8))}
    joint = rng.choice(list(tree["joints"].values()))
    sizes: Any = {"pin": {"radius": "20 mm"}, "slider": {"guide": ["40 mm", "40 mm"]}}.get(joint["type"], {})
    joint["friction"] = {"coefficient": rng.choice((0.02, 0.2, 0.6)), **sizes}


def _load(tree: Tree, rng: random.Random) -> None:
    """A force or a couple on a link that is moved."""
    link = rng.choice([k for k in tree["links"] if k != "ground"])
    by = rng.choice([*tree.get("drives", {}), f"links.{link}.angle"])
    law = rng.choice((*LAWS, "12", "unknown")).format(by)
    point = rng.choice(list(tree["links"][link].get("points", {})))
    put_on: Tree = {"type": "couple", "on": link, "value": law}
    if rng.random() < 0.6:
        put_on |= {"type": "force", "at": point, "direction": rng.choice((0, 90, 200))}
    if any(len(p) == 3 for p in tree["links"][link].get("points", {}).values()):
        put_on["direction"] = rng.choice(([0, 0, 1], [1, 0, 0], [1, 2, -1]))
    loads = tree.setdefault("loads", {})
    loads["put"] = put_on
    if put_on["type"] == "force" and rng.random() < 0.3:
        loads["put"]["axes"] = "link"


def _spring(tree: Tree, rng: random.Random) -> None:
    ends = [f"{k}.{p}" for k, link in tree["links"].items() for p in link.get("points", {})]
    kind = rng.choice(("spring", "spring", "damper"))
    made = {"type": kind, "between": rng.sample(ends, 2)}
    made |= (
        {"damping": 40} if kind == "damper" else {"stiffness": 300, "free_length": rng.choice((0, 0.1, 1))}
    )
    tree.setdefault("loads", {})["between"] = made


def _position(tree: Tree, rng: random.Random) -> None:
    drive = rng.choice(list(tree["drives"].values()))
    drive.pop("law", None)
    drive["position"] = deepcopy(rng.choice(POSITIONS))
    if rng.random() < 0.3:
        unit = "rad/s" if "deg" in str(drive["position"]) else "m/s"
        drive["speed"] = f"{rng.choice((0, 1, -2, 0.5))} {unit}"


def _twin(tree: Tree, rng: random.Random) -> None:
    """A joint, or a load, twice."""
    group = rng.choice(("joints", "loads"))
    name = rng.choice(list(tree[group]))
    made = tree[group]["twin"] = deepcopy(tree[group][name])
    if group == "joints":
        made.setdefault("at", [name, name])


def _turned(tree: Tree, rng: random.Random) -> None:
    """The links of a joint, exchanged with all that belongs to either."""
    joint = rng.choice(list(tree["joints"].values()))
    for key in ("links", "at", "radii", "teeth", "axes"):
        if isinstance(joint.get(key), list) and len(joint[key]) == 2:
            joint[key] = joint[key][::-1]


def _copies(tree: Tree, rng: random.Random) -> None:
    """A part beside itself, mirrored or turned."""
    movers = [k for k in tree["links"] if k != "ground"]
    angles = rng.choice(([0, 180], [0, 120, 240], [0, 10]))
    fixed = rng.choice(list(tree["links"]))
    how = rng.choice(({"mirror": {"ground": 90}}, {"mirror": 90}, {"phase": {fixed: angles}}))
    copied = [k for k in movers if k != fixed]
    tree["copies"] = [{"of": rng.sample(copied, rng.randint(1, len(copied))), **how}]


def _gravity(tree: Tree, rng: random.Random) -> None:
    tree["gravity"] = rng.choice(("standard", [0, 0], ["9.81 m/s^2", 0], [0, "-9.81 m/s^2"]))


def _still(tree: Tree, rng: random.Random) -> None:
    """A drive becomes one whose effort is given, with another unknown in its place."""
    drive = rng.choice(list(tree["drives"].values()))
    drive["effort"] = rng.choice((0, 5, -20))
    _load(tree, rng)
    tree["loads"]["put"]["value"] = "unknown"


WAYS: tuple[Callable[[Tree, random.Random], None], ...] = (
    *(_number, _number, _number, _text_number, _text_number, _point, _graft, _graft, _graft, _top, _removed),
    *(_friction, _load, _load, _spring, _position, _position, _twin, _turned, _copies, _gravity, _still),
)
