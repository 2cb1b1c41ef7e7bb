"""The rows of a layout as relations between two links: what the closed forms of positions recognise."""

from __future__ import annotations

from dataclasses import dataclass

from dalembert.arrays import Array
from dalembert.core.layout import Along, Distance, Layout, Meet, Mesh, Turn
from dalembert.kernel.graph import Scalar, is_zero
from dalembert.kernel.position.plane_vectors import Pair


@dataclass(frozen=True)
class Relation:
    """One condition between links i and j. ``kind``: meet (two rows), along, roll (along with pitch), turn, distance,
    mesh. ``turn`` is the rotation (cos, sin) a turn keeps, ``target`` the measure."""

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


def relations(layout: Layout, target: Array, turns: dict[int, Pair]) -> list[Relation]:
    """Every condition of the stacked system; ``turns`` gives (cos, sin) of the targets of turn rows."""
    out = []
    for f in layout.stack.families:
        for k in range(len(f.i)):
            rows = tuple(int(r) for r in f.row[k]) if isinstance(f, Meet) else (int(f.row[k]),)
            kind = _KINDS[type(f)]
            if isinstance(f, Along) and not is_zero(f.pitch[k]):
                kind = "roll"
            arms = (f.ui, f.uj) if isinstance(f, Meet | Along | Distance | Mesh) else ()
            ui, uj = ((u[k][0], u[k][1]) for u in arms) if arms else (NONE, NONE)
            axis = (f.axis[k][0], f.axis[k][1]) if isinstance(f, Along) else NONE
            radii = (f.ri[k], f.rj[k]) if isinstance(f, Mesh) else NONE
            i, j, goal, turn = int(f.i[k]), int(f.j[k]), target[rows[0]], turns.get(rows[0], NONE)
            out.append(Relation(kind, i, j, ui, uj, axis, goal, turn, radii, rows))
    return out
