"""Mass, centre and inertia of the links whose shape, or STL mesh, gives them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.column import Scale
from dalembert.arrays import Array, Tree
from dalembert.printing import Part, TextTable, wrap

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

PRODUCTS = ((0, 1), (0, 2), (1, 2))


def shaped_links(m: Mechanism) -> list[str]:
    """Links with a shape that has mass."""
    return [n for n, link in m.links.items() if link.shapes and m.mass(n)]


def inertia_matrix(m: Mechanism, link: str) -> Array:
    """Inertia about the mass centre (3, 3), link axes, of a link with a shape; in the plane only about z."""
    known = np.asarray(m.inertia(link), float)
    return known if known.ndim == 2 else np.diag([0.0, 0.0, float(known)])


def shape_parts(r: Result, to: Printed) -> Iterator[Part]:
    """A table of what the shapes give, in link axes."""
    m = r.mechanism
    names, plane = shaped_links(m), m.dimension == 2
    if not names:
        return
    mass, length, unit = (to.text(kind) for kind in ("mass", "length", "inertia"))
    axes = "xy" if plane else "xyz"
    heads = ["shape of\nlink", f"mass\n{mass}", *(f"centre {x}\n{length}" for x in axes)]
    heads += [f"I zz\n{unit}"] if plane else [f"I {x}{x}\n{unit}" for x in axes]
    heads += [] if plane else [f"I {'xyz'[i]}{'xyz'[j]}\n{unit}" for i, j in PRODUCTS]
    rows = []
    for name in names:
        i = inertia_matrix(m, name)
        moments = [i[2, 2]] if plane else [*np.diag(i), *(i[at] for at in PRODUCTS)]
        floor = 1e-12 * np.abs(i).max()
        center = [to.number("length", x) for x in m.center(name)]
        shown = [to.number("inertia", x if abs(x) > floor else 0.0) for x in moments]
        rows.append([name, to.number("mass", m.mass(name)), *center, *shown])
    note = wrap("Centre in link axes, inertia about the centre along them, both computed from the shape.")
    yield TextTable(heads, rows, note=note)


def shape_record(r: Result, to: Scale) -> Tree:
    """The same by link."""
    m = r.mechanism
    return {
        name: {
            "mass": float(to("mass", m.mass(name))),
            "center": [float(to("length", x)) for x in m.center(name)],
            "inertia": float(to("inertia", m.inertia(name)))
            if m.dimension == 2
            else [[float(to("inertia", x)) for x in row] for row in inertia_matrix(m, name)],
        }
        for name in shaped_links(m)
    }
