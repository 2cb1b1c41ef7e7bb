"""The kinds of numbers of drives and loads: a drive that turns has an angle and a moment, one that slides a length."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from dalembert.model.paths import set_value
from dalembert.units import KINDS

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

LENGTHWISE = {"position": "length", "speed": "speed", "acceleration": "acceleration", "effort": "force"}
ANGULAR = {
    "position": "angle",
    "speed": "angular_speed",
    "acceleration": "angular_acceleration",
    "effort": "moment",
}


ANY = 1.25
"""Value that is not the default of any key: a file leaves out defaults."""


def kind_in_file(tree: object, keys: Sequence[str]) -> str:
    """Kind of the number at a path of a saved file, from `units.KINDS`, by the unit written with it."""
    for key in keys:
        if isinstance(tree, dict) and key.isdigit() and key not in tree:
            tree = list(tree.values())  # numbers that a file writes by name
        tree = tree[int(key)] if isinstance(tree, list) else tree.get(key) if isinstance(tree, dict) else None
    unit = tree.partition(" ")[2] if isinstance(tree, str) else ""
    return next((kind for kind, of in KINDS.items() if of.si == unit), "number")


def written_kind(m: Mechanism, path: str) -> str:
    """Kind of the number at a path of a description."""
    keys = path.split(".")
    return kind_in_file(set_value(m, keys, ANY).to_tree(), keys)


def drive_kinds(result: Result, drive: str) -> dict[str, str]:
    """Kinds of a drive's position, speed, acceleration and effort."""
    compiled = result.compiled
    row = compiled.layout.driven[result.drives.index(drive)]
    return ANGULAR if compiled.layout.freedoms.angular[row] else LENGTHWISE


def load_kind(result: Result, load: str) -> str:
    """Kind of a load: force, or moment of a couple or of a spring or damper in a turn."""
    return "force" if result.mechanism.loads[load].ON in ("point", "span") else "moment"


def contact_kind(result: Result, joint: str) -> str:
    """Kind of what a contact pushes with: force, or moment of a one-way clutch."""
    return "moment" if hasattr(result.mechanism.joints[joint], "RELEASED") else "force"


def in_plane(result: Result) -> bool:
    """True if a result is planar."""
    return result.mechanism.dimension == 2


def unknown_kinds(result: Result) -> dict[str, str]:
    """Kind of every unknown effort and load."""
    requested = zip(result.drives, result.compiled.known.requested, strict=True)
    kinds = {d: drive_kinds(result, d)["effort"] for d, a in requested if a}
    return kinds | {load: load_kind(result, load) for load in result.unknown_loads}
