"""The proof of a jam: it is never one where there is a solution, and it is found for most jams."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.core.friction.contact_equations import ContactResponse, argument, bearing
from dalembert.kernel.graph import Graph
from dalembert.kernel.jam_proof import jams
from tests.friction.rough import cycle, rough_tree
from tests.kernel.comparing import general
from tests.tiers import tiers

MANY = 400


def some_contacts(count: int, signed: int, balls: bool = False) -> Any:
    """Contacts of which so many have a force with a sign, or all those of balls; the proof reads nothing else."""
    m = cycle("four_bar", 1)
    known = compile_mechanism(m, m.schedule()).contacts
    assert known is not None
    every = np.full(count, balls)
    return replace(known, signed=np.arange(count) < signed, ball=every, joint=np.zeros(count, np.intp))


def proofs(contacts: Any, y: np.ndarray, h: np.ndarray, sense: np.ndarray) -> np.ndarray:
    """Where a jam is proved, for arguments y (3, E, position), H (3, E, E, position), senses (E, position)."""
    graph = Graph()

    def channels(array: np.ndarray) -> np.ndarray:
        out = np.empty(array.shape[:-1], object)
        for place in np.ndindex(out.shape):
            out[place] = graph.input("channel", str(place), array[place])
        return out

    r = ContactResponse(np.zeros(0), np.zeros(0), channels(y), channels(h))
    node = jams(graph, contacts, r, channels(sense))
    return np.asarray(graph.evaluate([node], {})[0] < 0)


@pytest.mark.parametrize(("signed", "balls"), [(0, False), (1, False), (0, True)])
@pytest.mark.parametrize("count", [1, 2, 4])
def test_where_there_is_a_solution_no_jam_is_proved(count: int, signed: int, balls: bool) -> None:
    """Random strong couplings with loads made for a solution: S = |y| is chosen, then y0 = y - H z."""
    rng = np.random.default_rng(count)
    contacts = some_contacts(count, min(signed, count - 1), balls)
    sense = rng.choice([-1.0, 1.0], (count, MANY))
    h = rng.normal(size=(3, count, count, MANY)) * rng.choice([0.5, 3.0, 30.0], MANY)
    y = rng.normal(size=(3, count, MANY)) * np.exp(rng.normal(size=(count, MANY)))
    z = -sense * np.stack([bearing(contacts, y[..., p]) for p in range(MANY)], axis=-1)
    y0 = y - np.einsum("cabp,bp->cap", h, z)
    back = argument(ContactResponse(np.zeros(0), np.zeros(0), y0[..., 0], h[..., 0]), z[:, 0])
    assert back == pytest.approx(y[..., 0])
    assert not proofs(contacts, y0, h, sense).any()


def test_one_contact() -> None:
    """S = |y0 + k S| has none where k > 1 and y0 > 0, and one where the load pulls the other way."""
    k, y0 = np.array([0.9, 1.1, 1.1, 5.0, np.nan, np.inf]), np.array([1.0, 1.0, -1.0, 2.0, 1.0, 1.0])
    y = np.zeros((3, 1, 6))
    y[0, 0] = y0
    h = np.zeros((3, 1, 1, 6))
    h[0, 0, 0] = k
    found = proofs(some_contacts(1, 0), y, h, -np.ones((1, 6)))
    assert list(found) == [False, True, False, True, False, False]


@pytest.mark.parametrize("drawn", tiers([(1, "jammed"), (22, "jammed")], [(3, "jammed"), (7, "at_rest")]))
def test_random_mechanisms(drawn: tuple[int, str]) -> None:
    """The kernel says so itself; at rest it does not matter whether there is one solution only."""
    seed, status = drawn
    m = da.mechanism(rough_tree(seed))
    k = da.compile(m)
    r = k(redo=False)
    assert set(r.status[0]) == {status}
    assert list(general(m, k, k.nominal).status) == list(r.status[0])
