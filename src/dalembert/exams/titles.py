"""The title of a variant: numbers in it that vary are those of the variant."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from dalembert.errors import ModelError
from dalembert.model.quantities.figures import si_quantity
from dalembert.unit_names import Unit, unit
from dalembert.units import KINDS, NUMBER

if TYPE_CHECKING:
    from dalembert.model import Mechanism

TOKEN = re.compile(rf"(?<![\w.])({NUMBER})(\s*)([^\W\d_][^\s,;:()]*|[°%])")
"""A number with a unit behind it."""


def variant_title(m: Mechanism, changed: Mechanism, paths: Iterable[str]) -> str:
    """The title of a problem with the numbers at some paths as another variant has them.

    >>> import dalembert as da
    >>> m = da.four_bar(crank=0.1).with_values({"title": "Four-bar, crank 100 mm"})
    >>> path = "links.crank.points.A.0"
    >>> variant_title(m, m.with_values({path: "120 mm"}), [path])
    'Four-bar, crank 120 mm'
    """
    if not TOKEN.search(m.title):
        return m.title
    pairs = [(_size(m, path), _size(changed, path)) for path in paths]

    def replaced(match: re.Match[str]) -> str:
        named = _unit(match[3])
        for old, new in pairs:
            if named is None or old is None or new is None or tuple(named.dimension) != old[1]:
                continue
            if math.isclose(named.si(float(match[1])), old[0], rel_tol=1e-9):
                return f"{named.of_si(new[0]):.6g}{match[2]}{match[3]}"
        return match[0]

    return TOKEN.sub(replaced, m.title)


def _unit(name: str) -> Unit | None:
    try:
        return unit(name)
    except ModelError:
        return None


def _size(m: Mechanism, path: str) -> tuple[float, tuple[float | None, ...]] | None:
    """The SI number at a path, of a vector its length, and its dimension; None if it is not a number."""
    if parameter := m.parameters.get(path.removeprefix("parameters.")):
        return float(parameter.value), tuple(parameter.dimension)
    tree: Any = m.to_tree()
    for key in path.split("."):
        tree = tree[int(key)] if isinstance(tree, list) else tree.get(key) if isinstance(tree, dict) else None
    parts = [si_quantity(item) for item in (tree if isinstance(tree, list) else [tree])]
    if not parts or parts[0] is None:
        return None
    return math.hypot(*(pair[0] for pair in parts if pair)), tuple(KINDS[parts[0][1]].dimension)
