"""The four-bar and the slider-crank as a textbook solves them: closed form, then D'Alembert's equations written out.

Ground pivots O2 (0, 0) and O4 (d, 0); crank a, coupler b, rocker c; mass centres (r @ delta) from O2, A, O4.
All at one position; no gravity; one force on the coupler at its mass centre, one couple on the rocker.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, atan2, cos, hypot, sin

import numpy as np


@dataclass(frozen=True)
class Body:
    """Mass, distance and angle of the mass centre from the link's first pin, inertia about the mass centre."""

    m: float
    r: float
    delta: float
    I: float  # noqa: E741


def four_bar(
    abcd: tuple[float, float, float, float],
    bodies: tuple[Body, Body, Body],
    force: tuple[float, float],
    couple: float,
    t2: float,
    w2: float,
    al2: float,
) -> dict[str, float]:
    """Open four-bar (B above the line A-O4): angles, rates, reactions F_ij (by i on j), torque T."""
    a, b, c, d = abcd
    p, q, s = bodies
    # closed form: the triangle A B O4
    ax, ay = a * cos(t2), a * sin(t2)
    diagonal = hypot(d - ax, ay)
    t3 = atan2(-ay, d - ax) + acos((b * b + diagonal**2 - c * c) / (2 * b * diagonal))
    t4 = atan2(ay + b * sin(t3), ax + b * cos(t3) - d)
    # velocity: a w2 + b w3 = c w4 in the directions along b and c
    w3 = a * w2 * sin(t4 - t2) / (b * sin(t3 - t4))
    w4 = a * w2 * sin(t2 - t3) / (c * sin(t4 - t3))
    # acceleration: the same two projections with the normal terms
    ex = -a * (al2 * sin(t2) + w2**2 * cos(t2)) - b * w3**2 * cos(t3) + c * w4**2 * cos(t4)
    ey = a * (al2 * cos(t2) - w2**2 * sin(t2)) - b * w3**2 * sin(t3) + c * w4**2 * sin(t4)
    al3 = -(ex * cos(t4) + ey * sin(t4)) / (b * sin(t4 - t3))
    al4 = -(ex * cos(t3) + ey * sin(t3)) / (c * sin(t4 - t3))
    # mass centres
    r2x, r2y = p.r * cos(t2 + p.delta), p.r * sin(t2 + p.delta)
    r3x, r3y = q.r * cos(t3 + q.delta), q.r * sin(t3 + q.delta)
    r4x, r4y = s.r * cos(t4 + s.delta), s.r * sin(t4 + s.delta)
    a2x, a2y = -al2 * r2y - w2**2 * r2x, al2 * r2x - w2**2 * r2y
    aax, aay = -al2 * ay - w2**2 * ax, al2 * ax - w2**2 * ay
    a3x, a3y = aax - al3 * r3y - w3**2 * r3x, aay + al3 * r3x - w3**2 * r3y
    a4x, a4y = -al4 * r4y - w4**2 * r4x, al4 * r4x - w4**2 * r4y
    # arms from each mass centre to the pins
    o2x, o2y, a2ax, a2ay = -r2x, -r2y, ax - r2x, ay - r2y
    a3ax, a3ay, b3x, b3y = -r3x, -r3y, b * cos(t3) - r3x, b * sin(t3) - r3y
    o4x, o4y, b4x, b4y = -r4x, -r4y, c * cos(t4) - r4x, c * sin(t4) - r4y
    # unknowns F12x F12y F23x F23y F34x F34y F14x F14y T
    equations = np.array([
        [1, 0, -1, 0, 0, 0, 0, 0, 0],
        [0, 1, 0, -1, 0, 0, 0, 0, 0],
        [-o2y, o2x, a2ay, -a2ax, 0, 0, 0, 0, 1],
        [0, 0, 1, 0, -1, 0, 0, 0, 0],
        [0, 0, 0, 1, 0, -1, 0, 0, 0],
        [0, 0, -a3ay, a3ax, b3y, -b3x, 0, 0, 0],
        [0, 0, 0, 0, 1, 0, 1, 0, 0],
        [0, 0, 0, 0, 0, 1, 0, 1, 0],
        [0, 0, 0, 0, -b4y, b4x, -o4y, o4x, 0],
    ])  # fmt: skip
    known = [
        p.m * a2x, p.m * a2y, p.I * al2,
        q.m * a3x - force[0], q.m * a3y - force[1], q.I * al3,
        s.m * a4x, s.m * a4y, s.I * al4 - couple,
    ]  # fmt: skip
    names = ("F12x", "F12y", "F23x", "F23y", "F34x", "F34y", "F14x", "F14y", "T")
    solved = dict(zip(names, np.linalg.solve(equations, known), strict=True))
    return solved | {"t3": t3, "t4": t4, "w3": w3, "w4": w4, "al3": al3, "al4": al4}


def slider_crank(
    r: float,
    l: float,  # noqa: E741
    e: float,
    bodies: tuple[Body, Body],
    piston: float,
    load: float,
    t2: float,
    w2: float,
    al2: float,
) -> dict[str, float]:
    """Piston pin on the line y = e; ``load`` on the piston along x through its pin, where its mass centre is."""
    p, q = bodies
    t3 = asin((e - r * sin(t2)) / l)
    w3 = -r * w2 * cos(t2) / (l * cos(t3))
    al3 = (r * w2**2 * sin(t2) - r * al2 * cos(t2) + l * w3**2 * sin(t3)) / (l * cos(t3))
    x = r * cos(t2) + l * cos(t3)
    dx = -r * w2 * sin(t2) - l * w3 * sin(t3)
    ddx = -r * al2 * sin(t2) - r * w2**2 * cos(t2) - l * al3 * sin(t3) - l * w3**2 * cos(t3)
    r2x, r2y = p.r * cos(t2 + p.delta), p.r * sin(t2 + p.delta)
    r3x, r3y = q.r * cos(t3 + q.delta), q.r * sin(t3 + q.delta)
    ax, ay = r * cos(t2), r * sin(t2)
    a2x, a2y = -al2 * r2y - w2**2 * r2x, al2 * r2x - w2**2 * r2y
    a3x = -al2 * ay - w2**2 * ax - al3 * r3y - w3**2 * r3x
    a3y = al2 * ax - w2**2 * ay + al3 * r3x - w3**2 * r3y
    bx, by = l * cos(t3), l * sin(t3)
    # backwards: piston along x, rod about A, then the crank
    f34x = piston * ddx - load
    m3 = q.I * al3 + q.m * (r3x * a3y - r3y * a3x)
    f34y = (by * f34x - m3) / bx
    f23x, f23y = q.m * a3x + f34x, q.m * a3y + f34y
    f12x, f12y = p.m * a2x + f23x, p.m * a2y + f23y
    torque = p.I * al2 + p.m * (r2x * a2y - r2y * a2x) + ax * f23y - ay * f23x
    out = {"F34x": f34x, "F34y": f34y, "F23x": f23x, "F23y": f23y, "F12x": f12x, "F12y": f12y}
    return out | {"N": -f34y, "T": torque, "t3": t3, "w3": w3, "al3": al3, "x": x, "dx": dx, "ddx": ddx}
