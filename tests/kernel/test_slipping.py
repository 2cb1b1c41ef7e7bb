"""What the kernel decides of friction itself, against all solutions, found by trying each sign of each force."""

from __future__ import annotations

from itertools import product
from typing import Any, NamedTuple

import numpy as np
import pytest

import dalembert as da
from dalembert.core.friction.contact_equations import ContactResponse
from dalembert.kernel.friction_trace import trace_slip
from dalembert.kernel.graph import Graph, Node
from dalembert.kernel.jam_proof import lever
from tests.kernel.test_jamming import some_contacts
from tests.tiers import tiers

Array = np.ndarray[Any, Any]
MANY = 1500


class Verdict(NamedTuple):
    """Friction z (E, P) that the kernel finds, where it vouches for it, and where it proves that there is none."""

    z: Array
    sure: Array
    jams: Array


def decided(pattern: Array, y: Array, h: Array, sense: Array) -> Verdict:
    """Of loads y (E, P), H (E, E, P) where the pattern has entries, and senses, compiled at a hundredth of H."""
    graph, values = Graph(), {}

    def channel(array: Array, nominal: Array) -> Node:
        node = graph.input("channel", str(len(values)), nominal[:1])
        values[node.index] = array
        return node

    count = len(y)
    first, couplings = np.zeros((3, count), object), np.zeros((3, count, count), object)
    told = np.empty(count, object)
    for a in range(count):
        first[0, a], told[a] = channel(y[a], y[a]), channel(sense[a], sense[a])
        for b in np.flatnonzero(pattern[a]):
            couplings[0, a, b] = channel(h[a, b], 0.01 * h[a, b])
    traced = trace_slip(
        graph,
        some_contacts(count, 0),
        ContactResponse(*(np.zeros(0),) * 2, *_nodes(graph, first, couplings)),
        told,
    )
    found, _, known = traced
    groups = (list(found), known.slips, known.unsure, known.sure, known.jam)
    with np.errstate(all="ignore"):
        z, *marks = (
            np.array([np.broadcast_to(v, y.shape[1:]) for v in graph.evaluate(g, values)]) for g in groups
        )
    doubt, unsure, single = (
        (~(m >= 0)).any(axis=0) if len(m) else np.zeros(y.shape[1], bool) for m in marks[:3]
    )
    undecided = unsure & single
    jam = undecided & ((marks[3] < 0).any(axis=0) if len(marks[3]) else False)
    return Verdict(z, ~doubt & ~undecided, jam)


def _nodes(graph: Graph, *arrays: Array) -> list[Array]:
    made: Any = np.frompyfunc(lambda x: x if isinstance(x, Node) else graph.constant(x), 1, 1)
    return [made(array) for array in arrays]


def solutions(y: Array, h: Array, sense: Array) -> tuple[Array, Array]:
    """How many solutions z + s |y + H z| = 0 has (P,), and one of them (P, E)."""
    count, lanes = y.shape
    found: list[Array] = []
    number, one = np.zeros(lanes, int), np.full((lanes, count), np.nan)
    matrix, load = np.moveaxis(h, -1, 0), y.T
    for signs in product((1.0, -1.0), repeat=count):
        turned = np.array(signs) * sense.T
        z = np.linalg.solve(np.eye(count) + turned[:, :, None] * matrix, -(turned * load)[..., None])[..., 0]
        argument = load + (matrix @ z[..., None])[..., 0]
        holds = (np.array(signs) * argument >= -1e-9 * np.abs(z).max(axis=1, keepdims=True)).all(axis=1)
        new = holds & ~np.any([np.isclose(z, other, rtol=1e-6).all(axis=1) for other in found], axis=0)
        found.append(np.where(holds[:, None], z, np.nan))
        number += new
        one = np.where(new[:, None], z, one)
    return number, one


PATTERNS = {
    "one contact": [[1]],
    "two that load each other": [[1, 1], [1, 1]],
    "one loads the next": [[1, 0], [1, 1]],
    "three in a row": [[1, 0, 0], [1, 1, 0], [0, 1, 1]],
    "two load the third": [[1, 1, 0], [1, 1, 0], [1, 1, 1]],
    "through one that does not load itself": [[1, 0, 0], [1, 0, 0], [0, 1, 1]],
}


@pytest.mark.parametrize("seed", tiers([0], range(1, 6), range(6, 20)))
@pytest.mark.parametrize("name", PATTERNS)
def test_what_is_decided_is_right(name: str, seed: int) -> None:
    """Where the kernel vouches there is one solution, that one; where it says jammed there is none."""
    pattern, rng = np.array(PATTERNS[name]), np.random.default_rng(seed)
    count = len(pattern)
    y = rng.normal(size=(count, MANY)) * np.exp(2 * rng.normal(size=(count, MANY)))
    h = pattern[..., None] * rng.normal(size=(count, count, MANY)) * rng.choice([0.3, 1.0, 4.0], MANY)
    sense = rng.choice([-1.0, 1.0], (count, MANY))
    found = decided(pattern, y, h, sense)
    number, one = solutions(y, h, sense)
    assert found.sure.sum() > 0.1 * MANY
    assert (number[found.sure] == 1).all()
    size = np.abs(one).max(axis=1) + np.abs(y).max(axis=0)
    assert (np.abs(found.z.T - one).max(axis=1) <= 1e-12 * size)[found.sure].all()
    assert found.jams.sum() > 0.01 * MANY
    assert (number[found.jams] == 0).all()
    assert ((number != 1) & ~found.sure).sum() > 0.01 * MANY


def test_a_last_step_that_is_not_small() -> None:
    """Seven contacts compiled where three steps are enough: elsewhere some need more, of which it is not sure."""
    rng = np.random.default_rng(0)
    y = rng.normal(size=(7, 500)) * np.exp(2 * rng.normal(size=(7, 500)))
    h = 0.16 * rng.normal(size=(7, 7, 500))
    found = decided(np.ones((7, 7)), y, h, np.ones((7, 500)))
    number, one = solutions(y, h, np.ones((7, 500)))
    right = np.abs(found.z.T - one).max(axis=1) <= 1e-12 * (np.abs(one).max(axis=1) + np.abs(y).max(axis=0))
    assert (number[found.sure] == 1).all()
    assert right[found.sure].all()
    assert found.sure.sum() > 3
    assert (~right & (number == 1)).sum() > 3


def dead_centre(across: float, turned: float) -> Any:
    """A slider-crank stretched out along a line, pushed along it with 1000 N and across it with a little."""
    c, s = np.cos(turned), np.sin(turned)
    joints = {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "A": {"type": "pin", "links": ["crank", "rod"]},
        "B": {"type": "pin", "links": ["rod", "slide"]},
        "guide": {
            "type": "slider",
            "links": ["ground", "slide"],
            "at": ["G", "B"],
            "direction": np.degrees(turned),
            "friction": {},
        },
    }
    links = {
        "ground": {"points": {"O": [0, 0], "G": [c, s]}},
        "crank": {"points": {"O": [0, 0], "A": [0.1, 0]}},
        "rod": {"points": {"A": [0, 0], "B": [0.4, 0]}},
        "slide": {"points": {"B": [0, 0]}},
    }
    force = [1000 * c - across * s, 1000 * s + across * c]
    return da.mechanism(
        {
            "gravity": "none",
            "friction": {"coefficient": 0.2},
            "links": links,
            "joints": joints,
            "drives": {"O": {"position": [np.degrees(turned)], "speed": "2 rad/s"}},
            "loads": {"F": {"type": "force", "on": "slide", "at": "B", "value": force}},
            "assembly": {"rod": np.degrees(turned)},
        }
    )


@pytest.mark.parametrize(
    ("across", "turned", "status"),
    [(1.0, 0.4, "reversal"), (1e-6, 0.0, "reversal"), (1e-6, 0.4, "reversal"), (0.0, 0.0, "ok")],
)
def test_how_little_a_slide_that_reverses_may_carry(across: float, turned: float, status: str) -> None:
    """With a thousandth or a thousand millionth of the largest force it has two numbers, with nothing one."""
    m = dead_centre(across, turned)
    k = da.compile(m, vary=["loads.F.value", "drives.O.speed"], static=True, lanes=1)
    assert da.statics(m).status == (status,)
    assert list(k().status[0]) == [status]


def test_the_bound_of_a_length() -> None:
    """It is above the length, by no more than a twelfth, and nothing below the tilting force is one; of the three
    components of a ball's force by no more than a sixth."""
    pin, ball = np.zeros(1, bool), np.ones(1, bool)
    angle = np.linspace(0, 2 * np.pi, 721)
    h = np.zeros((3, 1, 721))
    h[0, 0], h[1, 0] = np.cos(angle), np.sin(angle)
    assert (lever(h, pin) >= 1).all()
    assert lever(h, pin).max() < 1.09
    h[2] = 5.0
    assert (lever(h, pin) == 5).all()
    h = np.random.default_rng(1).normal(size=(3, 1, 1000))
    over = lever(h, ball) / np.linalg.norm(h, axis=0)
    assert 1 <= over.min() < over.max() < 1.17


def kite(scale: float) -> Any:
    """Crank and frame of one length, coupler and rocker of another: the pins A and O4 meet where the crank is at 0."""
    points = {"crank": ("O2", "A", 0.3), "coupler": ("A", "B", 0.5), "rocker": ("O4", "B", 0.5)}
    body = {"mass": 1, "inertia": 0.01, "center": [0, 0]}
    links = {
        n: {"points": {a: [0, 0], b: [scale * size, 0]}, "center": [0, 0]} | body
        for n, (a, b, size) in points.items()
    }
    return da.mechanism(
        {
            "gravity": [0, -9.81],
            "links": {"ground": {"points": {"O2": [0, 0], "O4": [scale * 0.3, 0]}}} | links,
            "joints": {
                n: {"type": "pin", "links": pair}
                for n, pair in {
                    "O2": ["ground", "crank"],
                    "A": ["crank", "coupler"],
                    "B": ["coupler", "rocker"],
                    "O4": ["ground", "rocker"],
                }.items()
            },
            "drives": {"O2": {"position": [30, 20, 10], "speed": "5 rad/s"}},
            "assembly": {"coupler": 60, "rocker": 80},
        }
    )


def test_a_larger_design_beside_a_change_point() -> None:
    """How near it is does not depend on the size of what was compiled."""
    lengths = [
        "links.ground.points.O4",
        "links.crank.points.A",
        "links.coupler.points.B",
        "links.rocker.points.B",
    ]
    k, large = da.compile(kite(1.0), vary=lengths, lanes=1), da.compile(kite(1000.0), vary=lengths, lanes=1)
    near = {"positions": [0.5, 1e-3, 1e-5, 1e-6], "redo": False}
    assert list(k(large.nominal, **near).status[0]) == ["ok", "undecided", "undecided", "undecided"]
    assert list(large(**near).status[0]) == ["ok", "undecided", "undecided", "undecided"]
