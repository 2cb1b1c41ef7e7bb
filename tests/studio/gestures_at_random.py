"""Gestures drawn at random on whatever a document shows, sensible ones and others."""

from __future__ import annotations

from random import Random
from typing import Any

from dalembert.studio.document import Document

OPS = (
    *("bar",) * 3,
    *("ground", "point", "merge", "slider", "slot", "gear", "drive", "force", "couple", "spring", "damper"),
    *("slide", "weld", "circular_slot", "rolling", "belt", "cam"),
    *("cylinder", "pose", "set", "length", "changes"),
    *("move",) * 3,
    *("rename",) * 2,
    *("delete",) * 3,
)


def place(r: Random) -> list[float]:
    return [r.uniform(-0.2, 0.3), r.uniform(-0.2, 0.3)]


def where(r: Random, links: list[Any]) -> dict[str, Any]:
    """A place; mostly at a point of a link."""
    link = r.choice(links)
    if r.random() < 0.25 or not link["points"]:
        return {"at": place(r)}
    point = r.choice(list(link["points"]))
    return {"at": link["points"][point], "link": link["name"], "point": point}


def message(r: Random, d: Document) -> dict[str, Any]:
    """A message of the browser."""
    drawn = d.reading.drawing
    links, op = drawn["links"], r.choice(OPS)
    link = r.choice(links)
    joint = r.choice(drawn["joints"])["name"] if drawn["joints"] else "none"
    one, two = where(r, links), where(r, links)
    near = [x + r.uniform(-0.02, 0.02) for x in one["at"]]
    kind = r.choice(["links", "joints", "loads", "drives", "points"])
    names = list(link["points"]) if kind == "points" else [part["name"] for part in drawn[kind]]
    named = {"kind": kind, "name": r.choice(names) if names else "none"}
    if kind == "points":
        named["link"] = link["name"]
    return {"op": op} | {
        "bar": {"ends": [one, two], "length": r.choice(["", "50", "2 in", "1,5"])},
        "ground": {"where": one},
        "point": {"link": link["name"], "at": place(r)},
        "slider": {"where": one, "guide": r.choice(["ground", link["name"]]), "direction": r.uniform(-3, 3)},
        "slide": {"where": one, "guide": link["name"], "direction": r.uniform(-3, 3)},
        "slot": {"where": one, "guide": r.choice(["ground", link["name"]]), "direction": r.uniform(-3, 3)},
        "drive": {"joint": joint, "here": r.uniform(-2, 2), "speed": r.choice(["", "10 rad/s"])},
        "force": {"where": one, "vector": [r.uniform(-9, 9), 3.0]},
        "couple": {"link": link["name"], "value": r.choice(["5 N*m", "3"])},
        "move": {"link": one.get("link", link["name"]), "point": one.get("point", "A"), "to": near},
        "pose": {"links": {link["name"]: [0.0, 0.0, r.uniform(-3, 3)]}},
        "set": {"path": ["links", link["name"], "mass"], "value": r.choice(["2 kg", "1,5 kg", "-1", ""])},
        "length": {"link": link["name"], "value": "70 mm"},
        "changes": {"values": {f"assembly.{link['name']}": r.uniform(-3, 3)}},
        "rename": named | {"to": f"n{r.randrange(1000)}"},
        "delete": named,
    }.get(op, {"first": one, "second": two})
