"""Drawings as looked at, in numbers: how many strokes of each kind, how long and where; every arrow and text.

`drawn_numbers.txt` holds them in millimetres of paper; `python -m tests.methods.test_drawn_numbers` writes it anew,
after a look at the drawings that change. Labels are in it without their places, which `test_paper.py` tests.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.machine.members.member_table import member_table
from dalembert.model.joints.pairs import PAIRS
from dalembert.model.library import TEMPLATES, template
from dalembert.views.charts import chart_scenes
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arc, Arrow, Circle, Item, Line, Polygon, Scene, Text
from tests.answers.every_answer import MADE, made
from tests.approved.printed import rubs as rubbing_engine
from tests.elements.test_one_way import FILE as ONE_WAY
from tests.friction.engines import engine
from tests.methods import space_machines, test_space_friction_drawings
from tests.methods.test_drawn_alike import Seen, plane_machine

CHECKED = Path(__file__).with_name("drawn_numbers.txt")

CHARTED = (
    *("Flywheel", "MotorChoice", "BearingTable", "Simulation", "RotorBalance", "PinTable"),
    *("CriticalSpeeds", "CamDesign"),
)
ELEMENTS = Path(__file__).parents[1] / "elements"

NEAR = 0.011
"""Millimetres: what is written has two digits after the point."""


class Labelled(str):
    """An anchor in the middle that knows how the label was to be placed."""

    wish = ""


def plain_label(self: Canvas, text: str, *near: Any, prefer: float | None = None, **more: Any) -> None:
    """A label amid the places it belongs to, with its direction in words."""
    if not text:
        return
    x, y = np.mean(near, axis=0)
    towards = "" if prefer is None else f" towards {round(math.degrees(prefer), 2) % 360:.2f}"
    look = {key: more[key] for key in ("size", "role") if key in more}
    leads = "" if more.get("leads", True) else " without a leader"
    anchor = Labelled("middle")
    anchor.wish = f"label of {len(near)}{towards}{leads}"
    self.add(Text((float(x), float(y)), text, anchor=anchor, **look))


def example(name: str, **options: Any) -> Any:
    return da.dynamics(da.load({**cases(), **examples()}[name]), **options)


def plane_views() -> Iterator[tuple[str, Scene]]:
    d, r = da.draw, da.dynamics(plane_machine(Seen(), friction=True))
    yield "arm", d.mechanism(r, forces=True)
    yield "arm, rod", d.free_body(r, "rod")
    yield "arm, block", d.free_body(r, "block")
    yield "arm, lines of action on the rod", d.lines_of_action(r, "rod")
    yield "arm, displaced inertia of the rod", d.displaced_inertia(r, "rod")
    yield "arm, teeth", d.teeth(r)
    r = example("four_bar")
    yield "four-bar linkage", d.mechanism(r)
    yield "four-bar linkage, question", d.question(r)
    yield "four-bar linkage, coupler along and across", d.components(r, "coupler")
    yield "four-bar linkage, polygon of the coupler", d.force_polygon(r, "coupler")
    yield "four-bar linkage, chain", d.force_chain(r)
    r = example("quick_return")
    yield "quick return", d.mechanism(r, at=4)
    yield "quick return, motion", d.motion(r, at=4)
    yield "engine with friction", d.friction(da.statics(engine(mu=0.2, guide=0.1)))
    yield (
        "engine with friction, backwards",
        d.free_body(da.statics(engine(mu=0.2, guide=0.1, speed=-1.0)), "piston"),
    )
    at_rest = engine(mu=0.3, speed=0.0)
    yield "engine at rest", d.mechanism(da.statics(at_rest))
    yield "lift", d.mechanism(example("scissor_lift", positions=2), at=1, forces=True)
    yield "bucket, velocities", d.velocity_polygon(example("bucket", positions=3), at=1)
    yield "gear train, teeth", d.teeth(example("gear_train"))
    yield "bucket", d.free_bodies(example("bucket", positions=3), at=1)


def space_views() -> Iterator[tuple[str, Scene]]:
    d, solved = da.draw, space_machines.solved
    yield "four-bar linkage in space", d.mechanism(solved("rssr"), at=4, forces=True)
    yield (
        "four-bar linkage in space, coupler from the front",
        d.free_body(solved("rssr"), "coupler", at=4, camera="front"),
    )
    yield "joint of two shafts, from above", d.mechanism(solved("hooke"), at=3, camera="top")
    yield "shaft", d.free_body(solved("shaft"), "shaft", at=3)
    for name in ("rccc", "press", "rssp"):
        r = test_space_friction_drawings.solved(name)
        yield f"{name} with friction", d.friction(r, at=1)
        yield f"{name} with friction, last link", d.free_body(r, r.links[-1], at=2)
    yield "universal joint", d.joint("universal")


def machine_views() -> Iterator[tuple[str, Scene]]:
    d, steady = da.draw, da.load(examples()["four_bar"]).with_values({"drives.O2.acceleration": 0.0})
    r = da.dynamics(steady, positions=16)
    yield "shaking", d.machine(da.shaking(r))
    yield "balance", d.machine(da.balance(r, ["crank", "rocker"]))
    for name, other in (("four-bar linkage", r), ("linkage in space", space_machines.solved("rssr"))):
        drawn = [s for s in member_table(other).drawings() if "length" in " ".join(s.scales)]
        yield f"members of a {name}", d.beside([drawn[0], drawn[-1]])


def element_views() -> Iterator[tuple[str, Scene]]:
    """Machines with elements, and the symbol of every pair."""
    for name in TEMPLATES:
        r = da.solve(template(name))
        yield f"template {name}", da.draw.mechanism(r, at=len(r.status) // 3, forces=True)
    for name in PAIRS:
        if name != "universal":
            yield f"pair {name}", da.draw.joint(name)
    r = example("seed-002-3-four-link-three-forces")
    yield "instant centers", da.draw.instant_centers(r)
    yield "four-link linkage, motion", da.draw.motion(r)


def answer_views() -> Iterator[tuple[str, Scene]]:
    """What answers draw of themselves."""
    flat = json.loads((ELEMENTS / "cam_cases.json").read_text(encoding="utf-8"))[3]["file"]
    governors = {"Porter": da.porter_governor(), "Hartnell": da.hartnell_governor()}
    some: dict[str, Any] = {
        **{f"{name} governor": da.governor(m) for name, m in governors.items()},
        "governor with friction": da.governor(da.load(cases()["gov-12-porter-governor-with-friction"])),
        "power in a planetary train": da.solve(template("planetary_train")).power_flow(),
        **{name: made(name) for name in MADE if name in CHARTED},
        "flat follower": da.cam(da.loads(flat), "F"),
    }
    for name, answer in some.items():
        for k, scene in enumerate(answer.drawings()[:4], 1):
            yield f"{name}, drawing {k}", scene


def solved_views() -> Iterator[tuple[str, Scene]]:
    """Further views of results, and machines that have symbols of their own."""
    d, r = da.draw, example("quick_return")
    yield "quick return, accelerations", d.acceleration_polygon(r, at=4)
    yield from charts("quick return", r, 0, 1, -1)
    r = da.dynamics(template("scotch_yoke"), positions=7)
    yield "yoke, velocities", d.velocity_polygon(r, at=2)
    yield "yoke, accelerations", d.acceleration_polygon(r, at=2)
    r = da.dynamics(template("inverted_slider_crank"), positions=7)
    yield "swinging block, velocities", d.velocity_polygon(r, at=2)
    yield "swinging block, accelerations", d.acceleration_polygon(r, at=2)
    yield from charts("gear train", da.solve(da.load(examples()["gear_train"])), 0)
    yield "superposition", d.superposition(example("seed-002-3-four-link-three-forces"))
    yield "brakes", d.mechanism(da.solve(da.load(ELEMENTS / "brakes.yaml")), forces=True)
    pads = "{radius: 20, at: 80}"
    text = (ELEMENTS / "brakes.yaml").read_text(encoding="utf-8")
    text = text.replace("radii: [50, 100], force", f"button: {pads}, force")
    yield "brake with pads", d.mechanism(da.statics(da.loads(text)))
    yield "one-way clutch", d.mechanism(da.statics(da.loads(ONE_WAY)), forces=True)
    yield from charts("linkage in space", space_machines.solved("rssr"), 0, -1)
    yield from charts("engine that rubs", da.solve(rubbing_engine()), 0, 1)


def charts(name: str, r: Any, *which: int) -> Iterator[tuple[str, Scene]]:
    some = chart_scenes(r)
    for k in which:
        yield f"{name}, chart {k % len(some) + 1} of {len(some)}", some[k]


DRAWN = {
    "plane": plane_views,
    "space": space_views,
    "machine": machine_views,
    "elements": element_views,
    "answers": answer_views,
    "solved": solved_views,
}


def digest(scene: Scene) -> Iterator[str]:
    """A drawing in words and numbers, a line for each kind of stroke, arrow and text, whatever their order."""
    strokes: dict[str, list[Item]] = {}
    rest = []
    for item in scene.flat():
        if isinstance(item, Arrow):
            head = f"{item.kind} {item.of} " + ("" if item.value is None else f"{item.value:.6g}")
            rest.append(
                f"arrow {item.role} from {numbers(item.tail)} to {numbers(item.head)}: {head.strip()}"
            )
        elif isinstance(item, Text):
            wish = getattr(item.anchor, "wish", item.anchor)
            rest.append(
                f"text {item.role} at {numbers(item.at)}, {item.size:g} mm, {wish}: {rounding(item.text)}"
            )
        else:
            kind = type(item).__name__.lower() + (" arrow" if getattr(item, "arrow", False) else "")
            strokes.setdefault(f"{kind} {item.role}", []).append(item)
    yield f"scales: {', '.join(f'{k} {v:.6g}' for k, v in sorted(scene.scales.items()))}"
    for name, some in sorted(strokes.items()):
        yield f"{name}: {measures(some)}"
    yield from sorted(rest)


def rounding(text: str) -> str:
    """A text without the number that only rounding makes."""
    return re.sub(r"closure gap \S+", "closure gap", text)


def measures(some: list[Any]) -> str:
    """Of strokes of one kind how many, how long, their middle, the box around them; of arcs how far they turn."""
    each = [outline(item) for item in some]
    pieces = np.array([(*a, *b) for points in each for a, b in pairwise(points)], float).reshape(-1, 2, 2)
    lengths = np.hypot(*(pieces[:, 1] - pieces[:, 0]).T)
    total = float(lengths.sum())
    middle = (lengths @ pieces.mean(axis=1)) / max(total, 1e-9)
    ends = np.concatenate([np.array(points, float) for points in each])
    box = numbers((*ends.min(axis=0), *ends.max(axis=0)))
    turned = math.degrees(sum(i.end - i.start for i in some if isinstance(i, Arc)))
    turn = f", turn {turned:.1f}" if isinstance(some[0], Arc) else ""
    return f"{len(some)}, {total:.2f} mm, middle {numbers(middle)}, in {box}{turn}"


def outline(item: Item) -> list[tuple[float, float]]:
    if isinstance(item, Circle):
        return list(Arc(item.center, item.radius, 0.0, 2 * math.pi).points)
    if isinstance(item, Polygon):
        return [*item.points, item.points[0]]
    assert isinstance(item, (Line, Arc))
    return list(item.points)


def numbers(some: Any) -> str:
    return " ".join(f"{x:.2f}" for x in np.asarray(some, float) + 0.0)


@cache
def checked() -> dict[str, list[str]]:
    """The lines of each drawing by its name."""
    parts = CHECKED.read_text(encoding="utf-8").split("\n\n")
    return {name: rest for name, *rest in (part.strip().splitlines() for part in parts)}


def alike(a: str, b: str, off: float = NEAR) -> bool:
    """True if two lines say the same, their numbers up to rounding."""
    words = list(zip(a.split(" "), b.split(" "), strict=False))
    return len(a.split(" ")) == len(b.split(" ")) and all(x == y or near(x, y, off) for x, y in words)


def near(a: str, b: str, off: float) -> bool:
    try:
        x, y = float(a.strip("[],:")), float(b.strip("[],:"))
    except ValueError:
        return False
    return abs(x - y) <= max(off, 2e-5 * abs(y))


@pytest.mark.parametrize("kind", DRAWN)
def test_drawings_are_as_they_were_checked(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Canvas, "label", plain_label)
    for name, scene in DRAWN[kind]():
        left = list(checked()[name])
        for line in digest(scene):
            same = next((k for k, other in enumerate(left) if alike(line, other)), None)
            assert same is not None, f"{name}: drawn is '{line}', of what was checked there are left {left}"
            del left[same]
        assert left == [], name


def written() -> str:
    out = []
    for views in DRAWN.values():
        out += ["\n".join([name, *digest(scene)]) for name, scene in views()]
    return "\n\n".join(out) + "\n"


if __name__ == "__main__":
    Canvas.label = plain_label  # type: ignore[method-assign]
    CHECKED.write_text(written(), encoding="utf-8")
