"""Powers of a machine as bands between its links: their width is the power, what is lost ends in the band."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arrow, Line, Polygon, Scene, Text

if TYPE_CHECKING:
    from dalembert.analysis.methods.power_flow import PowerFlow

COLUMN, ROW, WIDE, BAND = 44.0, 9.0, 5.0, 22.0
"""Distance of columns, gap between boxes, width of a box, and width of the band of the input, mm."""

SEEN = 1e-9
"""Part of the input from which on a power is drawn."""


class Stream(NamedTuple):
    """Power that leaves one node and reaches another, and what carries it."""

    start: str
    stop: str
    out: float
    into: float
    name: str


def power_scene(f: PowerFlow, notation: Notation | None = None) -> Scene:
    """Sources on the left, links in the middle by how the power reaches them, what takes it on the right."""
    shown, streams = Shown(f.result, notation or Notation()), _streams(f)
    scale = BAND / max(float(f.input[0]), 1e-300)
    place, height = _places(streams, scale)
    canvas = Canvas()
    used = {(name, side): place[name][1] + height[name] / 2 for name in place for side in (0, 1)}
    for s in streams:
        ends = []
        for name, side, size in ((s.start, 1, s.out * scale), (s.stop, 0, s.into * scale)):
            x, top = place[name][0] + (WIDE if side else 0.0), used[name, side]
            used[name, side] = top - size
            ends.append((x, top, top - size))
        (xa, ta, ba), (xb, tb, bb) = ends
        canvas.add(Polygon(((xa, ta), (xb, tb), (xb, bb), (xa, ba)), "bar"))
        if s.out - s.into > SEEN * s.out:  # what is lost ends below
            tip = ((xa + xb) / 2, (ba + bb) / 2 - 5.0)
            canvas.add(
                Arrow(((xa + xb) / 2, (ba + bb) / 2), tip, "friction", s.name, "power", s.out - s.into)
            )
            canvas.add(
                Text((tip[0] + 1.0, tip[1]), shown.text("power", s.out - s.into), 2.2, "note", "start")
            )
        words = f"{s.name} {shown.text('power', s.out)}" if s.name else shown.text("power", s.out)
        canvas.add(Text(((xa + xb) / 2, (ta + ba + tb + bb) / 4), words, 2.4, "text"))
    for name, (x, y) in place.items():
        half = height[name] / 2
        canvas.add(
            Polygon(((x, y - half), (x + WIDE, y - half), (x + WIDE, y + half), (x, y + half)), "link-area")
        )
        canvas.add(Text((x + WIDE / 2, y + half + 2.0), name, 3.0, "text"))
    if f.circulating[0] > 0:
        low = min(y - height[n] / 2 for n, (_, y) in place.items()) - 8.0
        text = f"{shown.text('power', float(f.circulating[0]))} circulate beyond the input"
        canvas.add(Line(((0.0, low), (6.0, low)), "resultant"), Text((8.0, low), text, 2.8, "note", "start"))
    return canvas.scene("Power flow")


def _streams(f: PowerFlow) -> list[Stream]:
    """Bands of the first position, each in the sense in which its power goes."""
    least, out = SEEN * float(f.input[0]), []
    for name, power in f.sources.items():
        p = float(power[0])
        link = _link_of(f, name)
        if abs(p) > least:
            out.append(
                Stream(f"{name} in", link, p, p, "") if p > 0 else Stream(link, f"{name} out", -p, -p, "")
            )
    for name, both in f.through.items():
        i, j = f.result.mechanism.joints[name].links
        a, b = (float(x) for x in both[0])
        if max(abs(a), abs(b)) > least and "ground" not in (i, j):
            out.append(Stream(i, j, a, b, name) if a + b > 0 else Stream(j, i, -b, -a, name))
    return out


def _link_of(f: PowerFlow, source: str) -> str:
    """The moving link that a drive or a load acts on."""
    m = f.result.mechanism
    if source in m.drives:
        i, j = m.joints[m.drive_joint(source)].links
        return j if j != "ground" else i
    load = m.loads.get(source)
    on = getattr(load, "on", None)
    if on is None and getattr(load, "between", None):
        on = next(link for link, _ in load.between if link != "ground")  # type: ignore[union-attr]
    if on is None and getattr(load, "joint", None):
        on = m.joints[load.joint].links[1]  # type: ignore[union-attr]
    return on or source


def _places(streams: list[Stream], scale: float) -> tuple[dict[str, tuple[float, float]], dict[str, float]]:
    """Left end and middle of each node's box, and its height."""
    nodes = list(dict.fromkeys(n for s in streams for n in (s.start, s.stop)))
    fed = {s.stop for s in streams}
    depth = {n: 0 for n in nodes if n not in fed} or dict.fromkeys(nodes[:1], 0)
    front = list(depth)
    while front:
        ahead = [s.stop for n in front for s in streams if s.start == n and s.stop not in depth]
        depth |= {
            n: depth[next(s.start for s in streams if s.stop == n and s.start in depth)] + 1 for n in ahead
        }
        front = list(dict.fromkeys(ahead))
    depth = {n: depth.get(n, 1) for n in nodes}
    last = max(depth.values(), default=0)
    ends = {n for n in nodes if all(s.start != n for s in streams)}
    depth |= dict.fromkeys(ends, max(last, 1))
    height = {
        n: scale
        * max(sum(s.out for s in streams if s.start == n), sum(s.into for s in streams if s.stop == n))
        for n in nodes
    }
    place, filled = {}, dict[int, float]()
    for n in nodes:
        top = filled.get(depth[n], 0.0)
        place[n] = (COLUMN * depth[n], top - height[n] / 2)
        filled[depth[n]] = top - height[n] - ROW
    return place, height
