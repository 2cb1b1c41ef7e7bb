"""Model trees made wrong at random: whatever a file says, the answer must be honest."""

from __future__ import annotations

import random
from collections.abc import Callable
from copy import deepcopy
from typing import Any

Path = tuple[Any, ...]

ODD: tuple[Any, ...] = (
    0, 0.0, -1, 1, 3, 1e-12, 1e12, 1e300, -1e-300, float("nan"), float("inf"), "", "nonsense", "5 parsecs", "3 @ 30",
    "7 mm", "2 kg", "45 deg", "10 rpm", "unknown", "ground", "slider", "1e400", None, True, [], {}, [1],
    [0, 0], [1, 2, 3], [None, "x"], {"from": 0, "to": 360, "count": 4}, {"from": 1, "to": 0, "count": -2},
    "__import__('os')", "sin(O2)", "é",
)  # fmt: skip


def paths(node: Any, at: Path = ()) -> list[Path]:
    """Every place of a tree below the root."""
    children = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [p for key, child in children for p in [(*at, key), *paths(child, (*at, key))]]


def get(tree: Any, path: Path) -> Any:
    for key in path:
        tree = tree[key]
    return tree


def put(tree: Any, path: Path, value: Any) -> None:
    get(tree, path[:-1])[path[-1]] = value


def mutated(tree: dict[str, Any], seed: int) -> dict[str, Any]:
    """The tree with one to four things changed; the same for the same seed."""
    rng, made = random.Random(seed), deepcopy(tree)
    for _ in range(rng.choice((1, 1, 1, 2, 2, 3, 4))):
        places = paths(made)
        if places:
            rng.choice(WAYS)(made, rng, places)
    return made


def _odd_value(tree: Any, rng: random.Random, places: list[Path]) -> None:
    put(tree, rng.choice(places), deepcopy(rng.choice(ODD)))


def _removed(tree: Any, rng: random.Random, places: list[Path]) -> None:
    path = rng.choice(places)
    del get(tree, path[:-1])[path[-1]]


def _copied(tree: Any, rng: random.Random, places: list[Path]) -> None:
    """One place's value at another: lengths that no longer close, joints of the wrong links."""
    put(tree, rng.choice(places), deepcopy(get(tree, rng.choice(places))))


def _renamed(tree: Any, rng: random.Random, places: list[Path]) -> None:
    path = rng.choice([p for p in places if isinstance(p[-1], str)] or [("x",)])
    node = get(tree, path[:-1])
    if path[-1] in node:
        node[path[-1] + rng.choice(("x", " ", "2"))] = node.pop(path[-1])


def _stretched(tree: Any, rng: random.Random, places: list[Path]) -> None:
    """A number times a factor: the likeliest slip of a user, and the one that stays readable."""
    numbers = [
        p for p in places if isinstance(get(tree, p), int | float) and not isinstance(get(tree, p), bool)
    ]
    if numbers:
        path = rng.choice(numbers)
        put(tree, path, get(tree, path) * rng.choice((0, -1, 0.5, 1.001, 2, 10, 1e-9, 1e9)))


def _retyped(tree: Any, rng: random.Random, places: list[Path]) -> None:
    joints = tree.get("joints")
    if isinstance(joints, dict) and joints:
        joint = rng.choice(list(joints.values()))
        if isinstance(joint, dict):
            joint["type"] = rng.choice(
                ("pin", "slider", "slot", "weld", "gear", "rolling", "cam", "revolute")
            )


def _rejoined(tree: Any, rng: random.Random, places: list[Path]) -> None:
    """A joint between two other links, or a joint too many, or one too few."""
    joints, links = tree.get("joints"), tree.get("links")
    if not (isinstance(joints, dict) and isinstance(links, dict) and joints and links):
        return
    name = rng.choice(list(joints))
    joint = joints.pop(name) if rng.random() < 0.3 else deepcopy(joints[name])
    if isinstance(joint, dict) and rng.random() < 0.8:
        joint["links"] = [rng.choice(list(links)), rng.choice(list(links))]
        joints[rng.choice((name, "extra"))] = joint


WAYS: tuple[Callable[[Any, random.Random, list[Path]], None], ...] = (
    _odd_value, _odd_value, _removed, _copied, _renamed, _stretched, _stretched, _stretched, _retyped, _rejoined,
)  # fmt: skip
