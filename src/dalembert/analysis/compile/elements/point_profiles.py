"""Cams by points: the curve of the follower's point, or the support function of a face, as polynomial pieces."""

from __future__ import annotations

import math

import numpy as np

from dalembert.arrays import Array
from dalembert.core.elements.cam_curves import piece
from dalembert.errors import ModelError
from dalembert.model.joints.elements.cam_profiles import CamPoints

EACH, MOST = 6, 720
"""Pieces for each two points, where the follower's curve differs from the cam's, and of all of them."""


def _spline(p: CamPoints) -> tuple[Array, Array]:
    """Breaks (n+1,) of a turn and coefficients (4, n) of the periodic cubic through the points."""
    from scipy.interpolate import CubicSpline

    x, y = list(p.angle), list(p.radius)
    if x[-1] - x[0] < 2 * math.pi * (1 - 1e-9):
        x, y = [*x, x[0] + 2 * math.pi], [*y, y[0]]
    y[-1] = y[0]
    spline = CubicSpline(x, y, bc_type="periodic")
    return np.asarray(x), np.asarray(spline.c)


def _fine(p: CamPoints) -> tuple[Array, Array]:
    """Angles (N,) and radius with three derivatives (4, N), several between two points."""
    x, c = _spline(p)
    each = max(min(EACH, MOST // (len(x) - 1)), 1)
    u = np.linspace(0.0, 1.0, each, endpoint=False)[:, None] * np.diff(x)
    r = ((c[0] * u + c[1]) * u + c[2]) * u + c[3]
    slope, bend = (3 * c[0] * u + 2 * c[1]) * u + c[2], 6 * c[0] * u + 2 * c[1]
    return (x[:-1] + u).T.ravel(), np.stack([a.T.ravel() for a in (r, slope, bend)])


def polar_points(name: str, p: CamPoints, roller: float) -> Array:
    """Distance of the follower's point over its direction."""
    if not roller:
        x, c = _spline(p)
        return np.array(
            [piece(float(x[k]), **{f"c{n}": c[3 - n, k] for n in range(4)}) for k in range(len(x) - 1)]
        )
    angle, (r, first, second) = _fine(p)
    size = np.hypot(r, first)
    rho = size**3 / (r * r + 2 * first * first - r * second)
    _undercut(name, angle, rho, roller)
    # the roller's centre is out along the normal (r, -r') / size, in radial and transverse axes
    along, aside = r + roller * r / size, -roller * first / size
    out = np.hypot(along, aside)
    direction = angle + np.arctan2(aside, along)
    # the offset curve has the same normal: its slope dR/dbeta = R tan(angle of the normal)
    tan = np.tan(np.arctan2(first, r) + np.arctan2(aside, along))
    slope = out * tan
    total = rho + roller
    bend = (out * out + 2 * slope * slope - np.hypot(out, slope) ** 3 / total) / out
    return _hermite(direction, out, slope, bend)


def flat_points(name: str, p: CamPoints) -> Array:
    """Support function over the direction of the face's normal."""
    angle, (r, first, second) = _fine(p)
    size = np.hypot(r, first)
    rho = size**3 / (r * r + 2 * first * first - r * second)
    if not (np.isfinite(rho) & (rho > 0)).all():
        k = int(np.flatnonzero(~(rho > 0) | ~np.isfinite(rho))[0])
        where = f"{math.degrees(angle[k]) % 360:.4g} deg"
        what = f"cam {name!r}: it is hollow at {where}, where a flat face does not reach it"
        raise ModelError(what, "take a roller or a knife edge", ("joints", name, "follower"))
    direction = angle - np.arctan2(first, r)
    support = r * r / size
    aside = r * first / size  # dH/dalpha: along the tangent
    return _hermite(direction, support, aside, rho - support)


def _undercut(name: str, angle: Array, rho: Array, roller: float) -> None:
    hollow = np.where(rho < 0, -rho, np.inf)
    k = int(np.argmin(hollow))
    if hollow[k] <= roller:
        raise roller_too_large(name, float(angle[k]), float(hollow[k]))


def roller_too_large(name: str, angle: float, radius: float) -> ModelError:
    """The error of a roller larger than the radius of a hollow, which is in a direction of the cam's axes."""
    where = f"{round(math.degrees(angle), 6) % 360:.4g} deg"
    return ModelError(
        f"cam {name!r}: the roller does not fit the hollow at {where}, of radius {radius * 1e3:.4g} mm",
        "make the roller smaller than that",
        ("joints", name, "follower"),
    )


def _hermite(x: Array, value: Array, slope: Array, bend: Array) -> Array:
    """Pieces of fifth degree, with these values and derivatives at increasing places of a turn."""
    from scipy.interpolate import BPoly

    x = np.append(x, x[0] + 2 * math.pi)
    data = np.stack([value, slope, bend], axis=-1)
    data = np.concatenate([data, data[:1]])
    rows = []
    for k in range(len(x) - 1):
        h = x[k + 1] - x[k]
        c = BPoly.from_derivatives([0.0, 1.0], [data[n] * h ** np.arange(3) for n in (k, k + 1)])
        coefficients = _powers(np.asarray(c.c)[:, 0])
        rows.append(piece(float(x[k]), **{f"c{n}": coefficients[n] / h**n for n in range(6)}))
    return np.array(rows)


def _powers(bernstein: Array) -> Array:
    """Coefficients of powers of a polynomial in Bernstein's form on 0 to 1."""
    n = len(bernstein) - 1
    out = np.zeros(n + 1)
    for k in range(n + 1):
        for i in range(k + 1):
            out[k] += math.comb(n, k) * math.comb(k, i) * (-1) ** (k - i) * bernstein[i]
    return out
