"""A mechanism with the changes made on a page."""

from __future__ import annotations

from collections.abc import Mapping

from dalembert.arrays import Tree
from dalembert.model import Mechanism


def with_changed_numbers(m: Mechanism, changes: Mapping[str, float]) -> Mechanism:
    """The mechanism with the numbers that a page has changed, and in the assembly mode that it shows.

    >>> import dalembert as da
    >>> with_changed_numbers(da.four_bar(), {"assembly.rocker": 1.8}).assembly
    {'rocker': 1.8}
    """
    numbers = {path: x for path, x in changes.items() if not path.startswith("assembly.")}
    poses: Tree = {}
    for path, x in changes.items():
        if path not in numbers:
            _, link, *keys = path.split(".")
            if len(keys) == 2:  # a vector, in the order of its components
                poses.setdefault(link, {}).setdefault(keys[0], []).append(x)
            elif keys:
                poses[link][keys[0]] = x
            else:
                poses[link] = x
    return m.with_values(numbers | ({"assembly": poses} if poses else {}))
