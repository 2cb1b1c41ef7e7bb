"""Intermediate results that are computed once for each answer and kept with it: the motion, the forces on the links."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TypeVar

Asked = TypeVar("Asked")
Value = TypeVar("Value")
_STORE = "_kept"


def kept(compute: Callable[[Asked], Value]) -> Callable[[Asked], Value]:
    """Decorator of a function of an answer: evaluated once for each answer, and kept with it.

    A copy made by `dataclasses.replace` and a pickled answer start without kept values, as their fields may differ.

    >>> from types import SimpleNamespace
    >>> answer, calls = SimpleNamespace(), []
    >>> doubled = kept(lambda r: calls.append(r))
    >>> doubled(answer), doubled(answer), len(calls)
    (None, None, 1)
    """

    @wraps(compute)
    def read(answer: Asked) -> Value:
        store: dict[Callable[[Asked], Value], Value] = vars(answer).setdefault(_STORE, {})
        if compute not in store:
            store[compute] = compute(answer)
        return store[compute]

    return read
