"""How far random tests go: the first few by default, more with the mark ``long``, the rest with ``exhaustive``."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import wraps
from itertools import product
from typing import Any

import pytest

BLOCK, LONG = 6, 1
"""Mechanisms in one test of a block, and how many blocks of each law are long."""


def tiers(quick: Iterable[Any], long: Iterable[Any], exhaustive: Iterable[Any] = ()) -> list[Any]:
    """The values of a parameter, each with the mark of its tier.

    >>> [(p.values[0], [m.name for m in p.marks]) for p in tiers([0], [1], [2])[1:]]
    [(1, ['long']), (2, ['exhaustive'])]
    """
    return [
        *quick,
        *(pytest.param(value, marks=pytest.mark.long) for value in long),
        *(pytest.param(value, marks=pytest.mark.exhaustive) for value in exhaustive),
    ]


def sampled(quick: Iterable[Any], every: Iterable[Any]) -> list[Any]:
    """Quick are these; of the rest, in order, every other one is long and what is left exhaustive.

    >>> [getattr(p, "values", p) for p in sampled("b", "edcba")]
    ['b', ('a',), ('d',), ('c',), ('e',)]
    """
    quick = list(quick)
    rest = sorted(set(every) - set(quick))
    return tiers(quick, rest[::2], rest[1::2])


def crossed(names: str, *lists: Iterable[Any]) -> Any:
    """Every combination: quick are so many that each value of each list is in one, the rest is long.

    >>> crossed("a, b", "xyz", [1, 2]).args[1][:3]
    [('x', 1), ('y', 2), ('z', 2)]
    """
    values = [list(some) for some in lists]
    places = range(max(map(len, values)))
    # each further list is one on for every time that it has begun again: no two run side by side
    quick = [tuple(v[(k + j * (k // len(v))) % len(v)] for j, v in enumerate(values)) for k in places]
    rest = [row for row in product(*values) if row not in quick]
    long = [pytest.param(*row, marks=pytest.mark.long) for row in rest]
    return pytest.mark.parametrize(names.split(", "), [*quick, *long])


_MET: dict[Callable[[int], bool], list[int]] = {}


def nth(n: int, holds: Callable[[int], bool]) -> int:
    """The nth seed, from 0, of which something holds, so that no law passes by what it does not speak of.

    >>> nth(2, lambda seed: seed % 3 == 1)
    7
    """
    met = _MET.setdefault(holds, [])
    while len(met) <= n:
        last = met[-1] if met else -1
        met.append(next(seed for seed in range(last + 1, last + 1000) if holds(seed)))
    return met[n]


def over(quick: int, whole: int = 1000, block: int = BLOCK) -> Callable[..., Any]:
    """A law on the first seeds, one test each, and on the rest of the whole a block a test."""
    return over_seeds(range(quick), range(quick, whole), block)


def over_seeds(quick: Iterable[int], rest: range, block: int = BLOCK) -> Callable[..., Any]:
    """A law on the quick seeds, one test each, and on the rest a block a test."""
    blocks = [rest[k : k + block] for k in range(0, len(rest), block)]

    def decorated(law: Callable[..., None]) -> Callable[..., None]:
        @wraps(law)
        def each(seed: int | range, **more: Any) -> None:
            for s in [seed] if isinstance(seed, int) else seed:
                law(seed=s, **more)

        return pytest.mark.parametrize("seed", tiers(quick, blocks[:LONG], blocks[LONG:]))(each)

    return decorated
