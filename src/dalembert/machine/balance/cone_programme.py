"""Second-order cone programmes: min c x with h - G x in a product of cones {(t, u): |u| <= t}.

Primal-dual interior points with the scaling of Nesterov and Todd and Mehrotra's corrector (Vandenberghe, The CVXOPT
linear and quadratic cone program solvers, 2010). The dual value, -h z, is a bound below every feasible c x:
it proves the optimum.

G (K, d, n), h (K, d): K cones of one dimension d; smaller ones are filled with rows of zeros. A cone of dimension 1 is
an inequality.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array

ROUNDS, ENOUGH = 100, 1e-13
BROKEN = 1e-100
"""Part of the largest number of the scaled equations below which one means that the scaling has broken down."""
SHORT = 0.995
"""Part of the distance to the boundary of the cones that a step takes."""


class ConeSolution(NamedTuple):
    """Point x (n,), primal and dual value, and the largest violation of the primal and dual equations, relative."""

    x: Array
    primal: float
    dual: float
    infeasible: float

    @property
    def gap(self) -> float:
        """Upper bound of the value's distance above the optimum, relative to 1 or to the value."""
        return abs(self.primal - self.dual) / max(1.0, abs(self.primal))


def minimise(c: Array, G: Array, h: Array) -> ConeSolution:
    """Solve a cone programme that has an optimum and points within all cones; c, G and h scaled to the order of 1."""
    with np.errstate(all="ignore"):  # behind the optimum the scaling breaks down, and the best point is kept
        return _minimise(c, G, h)


def _minimise(c: Array, G: Array, h: Array) -> ConeSolution:
    x, s, z = _start(c, G, h)
    best: ConeSolution | None = None
    for _ in range(ROUNDS):
        rx = np.einsum("kdn,kd->n", G, z) + c
        rz = G @ x + s - h
        now = ConeSolution(
            x, float(c @ x), float(-(h * z).sum()), float(max(np.abs(rx).max(), np.abs(rz).max()))
        )
        if best is None or now.gap + now.infeasible < best.gap + best.infeasible:
            best = now
        mu = (s * z).sum() / len(s)
        lost = now.gap + now.infeasible > 1e3 * (best.gap + best.infeasible + ENOUGH)
        if (mu < ENOUGH and now.infeasible < ENOUGH) or lost or not np.isfinite(mu):
            break
        scaling = _Scaling(s, z)
        lam = scaling.times(z)
        A = scaling.over(G)
        R: Array = np.asarray(np.linalg.qr(A.reshape(-1, len(x)), mode="r"))
        size = np.abs(np.diag(R))
        if not size.min() > BROKEN * size.max():
            break
        affine = _direction(scaling, A, R, rx, rz, lam, -_product(lam, lam))
        step = min(1.0, _reach(lam, affine[1]), _reach(lam, affine[2]))
        sigma = (1 - step) ** 3
        right = -_product(lam, lam) - _product(affine[1], affine[2])
        right[:, 0] += sigma * mu
        dx, ds, dz = _direction(scaling, A, R, (1 - sigma) * rx, (1 - sigma) * rz, lam, right)
        step = min(1.0, SHORT * _reach(lam, ds), SHORT * _reach(lam, dz))
        x, s, z = x + step * dx, s + step * scaling.times(ds), z + step * scaling.over(dz[..., None])[..., 0]
    assert best is not None
    return best


def _start(c: Array, G: Array, h: Array) -> tuple[Array, Array, Array]:
    """Least-squares points, moved along the cones' axes until they are within."""
    flat = G.reshape(-1, G.shape[-1])
    x = np.linalg.lstsq(flat, h.ravel(), rcond=None)[0]
    z = np.linalg.lstsq(flat.T, -c, rcond=None)[0].reshape(h.shape)
    return x, _inside(h - G @ x), _inside(z)


def _inside(v: Array) -> Array:
    out = v.copy()
    short = float((np.linalg.norm(v[:, 1:], axis=1) - v[:, 0]).max())
    if short > -1e-8 * max(1.0, float(np.abs(v).max())):
        out[:, 0] += 1 + max(short, 0.0)
    return out


class _Scaling:
    """W with W z = W^-1 s: eta [w_0, w_1'; w_1, I + w_1 w_1' / (1 + w_0)] of each cone."""

    def __init__(self, s: Array, z: Array) -> None:
        ss, zz = (np.sqrt(_square(v)) for v in (s, z))
        s, z = s / ss[:, None], z / zz[:, None]
        gamma = np.sqrt((1 + (s * z).sum(axis=1)) / 2)
        flipped = z.copy()
        flipped[:, 1:] *= -1
        self.w, self.eta = (s + flipped) / (2 * gamma[:, None]), np.sqrt(ss / zz)

    def times(self, v: Array) -> Array:
        return self._apply(v[..., None], self.w)[..., 0] * self.eta[:, None]

    def over(self, v: Array) -> Array:
        """W^-1 of columns (K, d, n)."""
        back = self.w.copy()
        back[:, 1:] *= -1
        return self._apply(v, back) / self.eta[:, None, None]

    def _apply(self, v: Array, w: Array) -> Array:
        head = np.einsum("kd,kdn->kn", w, v)
        inner = np.einsum("kd,kdn->kn", w[:, 1:], v[:, 1:])
        tail = v[:, 1:] + w[:, 1:, None] * (v[:, 0] + inner / (1 + w[:, :1]))[:, None, :]
        return np.concatenate([head[:, None, :], tail], axis=1)


def _square(v: Array) -> Array:
    size = np.linalg.norm(v[:, 1:], axis=1)
    return np.asarray(np.maximum((v[:, 0] - size) * (v[:, 0] + size), 1e-300))


def _product(a: Array, b: Array) -> Array:
    tail = a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:]
    return np.concatenate([(a * b).sum(axis=1, keepdims=True), tail], axis=1)


def _quotient(a: Array, r: Array) -> Array:
    """u with a o u = r."""
    head = (a[:, 0] * r[:, 0] - (a[:, 1:] * r[:, 1:]).sum(axis=1)) / _square(a)
    return np.concatenate([head[:, None], (r[:, 1:] - head[:, None] * a[:, 1:]) / a[:, :1]], axis=1)


def _direction(
    scaling: _Scaling, A: Array, R: Array, rx: Array, rz: Array, lam: Array, right: Array
) -> tuple[Array, Array, Array]:
    """dx, and ds and dz in scaled coordinates."""
    left = scaling.over(rz[..., None])[..., 0] + _quotient(lam, right)
    b = -rx - np.einsum("kdn,kd->n", A, left)
    dx = np.linalg.solve(R, np.linalg.solve(R.T, b))
    dx = dx + np.linalg.solve(R, np.linalg.solve(R.T, b - np.einsum("kdn,kdm,m->n", A, A, dx, optimize=True)))
    dz = A @ dx + left
    return dx, _quotient(lam, right) - dz, dz


def _reach(v: Array, d: Array) -> float:
    """Largest step along d that stays in the cones."""
    a = d[:, 0] ** 2 - (d[:, 1:] ** 2).sum(axis=1)
    b = v[:, 0] * d[:, 0] - (v[:, 1:] * d[:, 1:]).sum(axis=1)
    root = np.sqrt(np.maximum(b * b - a * _square(v), 0.0))
    with np.errstate(all="ignore"):
        steps = np.stack([_square(v) / (-b + root), _square(v) / (-b - root), -v[:, 0] / d[:, 0]])
    steps = np.where((steps > 0) & np.isfinite(steps), steps, np.inf)
    return float(steps.min(initial=np.inf))
