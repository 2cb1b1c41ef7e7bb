"""The branch of friction from none on, against its exact pieces: systems of contacts that need each safeguard of it.

Systems of one or several guides, y their arguments N and T of them, drawn at random, and of those the ones where a
safeguard decides: that the determinant stays positive, that Newton stays near its first step unless it goes hardly
anywhere, where the first slope is taken, how short the steps get, what is proved to be the only solution.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.core.friction.contact_equations import ContactResponse, SlipState
from dalembert.core.friction.friction_solver import solve_friction

Array = Any


def system(
    count: int, tilting: float, strong: float, seed: int, across: float = 0.0, many: int = 200
) -> tuple[Any, ContactResponse, Array]:
    """Systems of guides (or pins, with forces across too) that rub with a coefficient of 1, and their senses."""
    rng = np.random.default_rng(seed)
    y, h = rng.normal(size=(many, 3, count)), strong * rng.normal(size=(many, 3, count, count))
    parts = np.array([1.0, across, tilting])
    y, h = y * parts[:, None], h * parts[:, None, None]
    no, ones = np.zeros(count, bool), np.ones(count)
    contacts = SimpleNamespace(
        count=count,
        lever=ones,
        coefficient=ones,
        resting=ones,
        leader=np.arange(count),
        signed=no,
        fixed=no,
        circle=no,
        ball=no,
        grouped=False,
        around=no,
        wound=no,
    )
    r = ContactResponse(np.zeros((many, 1)), np.zeros((many, 1, count)), y, h)
    return contacts, r, np.sign(rng.normal(size=(many, count)))


def moving(sense: Array) -> SlipState:
    """No contact at rest."""
    return SlipState(sense, np.zeros(sense.shape, bool), sense)


class Piece:
    """Which argument each guide bears by, with its sign: there z + s sense S = 0 is linear in z."""

    def __init__(self, y: Array, h: Array, sense: Array, row: Array, sign: Array) -> None:
        self.y, self.h, self.sense, self.row, self.sign = y, h, sense, row, sign
        self.every = np.arange(len(sense))

    def matrix(self, s: float) -> Array:
        return np.eye(len(self.sense)) + s * (self.sense * self.sign)[:, None] * self.h[self.row, self.every]

    def z(self, s: float) -> Array:
        return np.linalg.solve(self.matrix(s), -s * self.sense * self.sign * self.y[self.row, self.every])

    def room(self, s: float) -> tuple[Array, Array]:
        """How much each guide's S is above its other arguments, or above 0; the arguments."""
        v = self.y + self.h @ self.z(s)
        others = np.abs(v)
        others[self.row, self.every] = 0.0
        return v[self.row, self.every] * self.sign - others.max(axis=0), v

    def holds(self, s: float) -> bool:
        if np.linalg.det(self.matrix(s)) <= 0:
            return False
        room, v = self.room(s)
        return bool(room.min() >= -1e-13 * np.abs(v).max())

    def last(self, s: float) -> float:
        """Where it ends, from s on."""
        grid = np.linspace(s, 1, 2001)[1:]
        out = next((k for k, t in enumerate(grid) if not self.holds(t)), None)
        if out is None:
            return 1.0
        low, high = grid[out - 1] if out else s, grid[out]
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if self.holds(middle) else (low, middle)
        return float(low)

    def next(self, s: float) -> Piece:
        """The piece on the other side: of the guide that has no room left another argument, or the other sign."""
        room, v = self.room(s)
        e = int(np.argmin(room))
        row, sign, others = self.row.copy(), self.sign.copy(), np.abs(v[:, e])
        others[row[e]] = 0.0
        if others.max() > 1e-12 * np.abs(v).max():
            row[e] = int(np.argmax(others))
            sign[e] = np.sign(v[row[e], e])
        else:
            sign[e] = -sign[e]
        return Piece(self.y, self.h, self.sense, row, sign)


def followed(y: Array, h: Array, sense: Array) -> tuple[Array | None, float]:
    """z at the scale 1; or the scale at which the branch ends, where forces go beyond all bounds or it turns back."""
    row = np.abs(y).argmax(axis=0)
    piece, s = Piece(y, h, sense, row, np.sign(y[row, np.arange(len(sense))])), 0.0
    for _ in range(30):
        s = piece.last(s)
        if s == 1:
            return piece.z(s), s
        if np.abs(piece.z(s)).max() > 1e8:
            return None, s
        piece = piece.next(s)
        if np.linalg.det(piece.matrix(s)) <= 0:
            return None, s
    raise AssertionError("more pieces than there are")


@pytest.mark.parametrize(
    ("count", "tilting", "strong", "seed", "which"),
    [
        (2, 0.0, 3.0, 1, [43, 71, 14, 19]),
        (3, 0.0, 1.0, 2, [7, 29, 10, 9, 128]),
        (2, 1.0, 3.0, 3, [155, 64, 91, 134]),
        (3, 1.0, 1.0, 4, [56, 80, 21]),
        pytest.param(3, 3.0, 1.0, 5, [55, 158, 51, 33, 131, 49], marks=pytest.mark.long),
    ],
)
def test_the_branch_is_that_of_its_exact_pieces(
    count: int, tilting: float, strong: float, seed: int, which: list[int]
) -> None:
    contacts, r, sense = system(count, tilting, strong, seed)
    part = ContactResponse(*(a[which] for a in r))
    found = solve_friction(contacts, part, moving(sense[which]))
    for k, n in enumerate(which):
        z, s = followed(r.y[n], r.h[n], sense[n])
        if z is None:
            assert found.critical[k] == pytest.approx(s, abs=1e-7), n
            assert np.isnan(found.z[k]).all()
        else:
            assert np.isnan(found.critical[k]), n
            assert found.z[k] == pytest.approx(z, rel=1e-8), n


def climbed(y: Array, h: Array, sense: Array) -> float:
    """Scale at which the branch of some pins ends, by small steps of plain Newton: there its determinant is 0."""

    def off(z: Array, s: float) -> Array:
        return z + s * sense * np.hypot(*(y + h @ z)[:2])

    def matrix(z: Array, s: float) -> Array:
        v = (y + h @ z)[:2]
        steep = v / np.hypot(*v)
        return np.eye(len(z)) + s * sense[:, None] * np.einsum("ae,aef->ef", steep, h[:2])

    z, s, step = np.zeros(len(sense)), 0.0, 1e-3
    while step > 1e-11 and s < 1:
        aim = min(s + step, 1.0)
        new = z.copy()
        for _ in range(8):
            new = new - np.linalg.solve(matrix(new, aim), off(new, aim))
        there = np.abs(off(new, aim)).max() < 1e-9 * np.abs(new).max() and np.linalg.det(matrix(new, aim)) > 0
        if there and np.abs(new - z).max() < 0.1 * np.abs(new).max() + 0.01:
            z, s = new, aim
        else:
            step /= 2
    return s


@pytest.mark.parametrize("n", [6, 276, 295])
def test_the_branch_of_pins_ends_at_its_fold(n: int) -> None:
    """Two solutions meet there; beyond, and on the way back, there are others."""
    contacts, r, sense = system(2, 0.0, 1.0, 11, 1.0, 300)
    part = ContactResponse(*(a[[n]] for a in r))
    found = solve_friction(contacts, part, moving(sense[[n]]))
    assert found.critical[0] == pytest.approx(climbed(r.y[n], r.h[n], sense[n]), abs=1e-6)
    assert np.isnan(found.z).all()
