"""Rows of a layout as relations between two links, as the closed forms of positions need them."""

from __future__ import annotations

from dataclasses import dataclass, replace

from dalembert.arrays import Array
from dalembert.core.elements.cam_family import CamGap, CamRow
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.elements.strand_family import Strand
from dalembert.core.layout import Along, BeltMesh, Distance, Layout, Meet, Mesh, Turn
from dalembert.kernel.graph import Node, Scalar, is_zero
from dalembert.kernel.position import plane_vectors as v
from dalembert.kernel.position.plane_vectors import Pair

PARALLEL = 1e-9
"""Sine of the angle of two lines below which they do not determine a point."""


@dataclass(frozen=True)
class Relation:
    """One condition between links i and j. ``kind``: meet (two rows), along, roll (along with pitch), turn, distance,
    mesh, cam, pressed (a brake on its drum). ``turn`` is the rotation (cos, sin) a turn keeps, ``target`` the
    measure."""

    kind: str
    i: int
    j: int
    ui: Pair
    uj: Pair
    axis: Pair
    target: Scalar
    turn: Pair
    radii: Pair
    rows: tuple[int, ...]


NONE: Pair = (0.0, 0.0)
_KINDS: dict[type, str] = {Meet: "meet", Along: "along", Turn: "turn", Distance: "distance", Mesh: "mesh"}
_KINDS |= {BeltMesh: "mesh", Strand: "strand", Lining: "pressed", BandStrands: "pressed", CamRow: "cam"}
_KINDS[CamGap] = "cam"
ARMED = Meet | Along | Distance | Mesh | Lining | BandStrands | CamRow


def relations(layout: Layout, target: Array, turns: dict[int, Pair]) -> list[Relation]:
    """Every condition of the stacked system; ``turns`` gives (cos, sin) of the targets of turn rows."""
    out = []
    for f in layout.stack.families:
        for k in range(len(f.i)):
            rows = tuple(int(r) for r in f.row[k]) if isinstance(f, Meet) else (int(f.row[k]),)
            kind = _KINDS[type(f)]
            if isinstance(f, Along) and not is_zero(f.pitch[k]):
                kind = "roll"
            arms = (f.ui, f.uj) if isinstance(f, ARMED) else ()
            ui, uj = ((u[k][0], u[k][1]) for u in arms) if arms else (NONE, NONE)
            axis = (f.axis[k][0], f.axis[k][1]) if isinstance(f, Along) else NONE
            radii = (f.ri[k], f.rj[k]) if isinstance(f, Mesh) else NONE
            i, j, goal, turn = int(f.i[k]), int(f.j[k]), target[rows[0]], turns.get(rows[0], NONE)
            out.append(Relation(kind, i, j, ui, uj, axis, goal, turn, radii, rows))
    return _driven_slides(out)


def _driven_slides(conditions: list[Relation]) -> list[Relation]:
    """Replaces two driven slides of one point by the conditions that hold it: along its slot's line, and across it."""
    out: dict[object, Relation] = {}
    for k, r in enumerate(conditions):
        key = (r.i, r.j, *map(_same, (*r.ui, *r.uj))) if r.kind == "along" else k
        first = out.get(key)
        if first is None:
            out[key] = r
            continue
        (a, s), (b, t) = (first.axis, first.target), (r.axis, r.target)
        sine = v.cross(a, b)
        if -PARALLEL < sine < PARALLEL:  # two guides that do the same
            out[k] = r
            continue
        over = 1.0 / sine
        shift = (over * (s * b[1] - t * a[1]), over * (t * a[0] - s * b[0]))
        rows = (*first.rows, *r.rows)
        out[key] = replace(first, kind="meet", ui=v.plus(r.ui, shift), axis=NONE, target=0.0, rows=rows)
    return list(out.values())


def _same(x: Scalar) -> object:
    """A key that is equal for two values if they are identical whatever the numbers."""
    return x.index if isinstance(x, Node) and x.op != "const" else ("number", float(x))
