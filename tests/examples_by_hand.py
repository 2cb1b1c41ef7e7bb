"""The examples' answers by closed formulas, without this package's analyses: name -> values in the order of the file.

Efforts follow from virtual work: with the positions of all mass centres as functions of one drive q,
effort = sum m a . dr/dq + sum I alpha dphi/dq - sum F . dr/dq. Numbers are in the units of the files.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import acos, asin, cos, degrees, pi, radians, sin, sqrt, tan

from mpmath import mp, mpf  # type: ignore[import-untyped]

from dalembert.bundled import examples

Place = Callable[[mpf], complex]
G = 9.80665


def rates(
    place: Callable[[mpf], object], q: float, speed: float, acceleration: float
) -> tuple[complex, complex]:
    """Slope along q, and second derivative in time, of a position or angle."""
    with mp.workdps(40):
        slope, bend = mp.diff(place, q), mp.diff(place, q, 2)
        return complex(slope), complex(bend * speed**2 + slope * acceleration)


def effort(
    q: float,
    speed: float,
    acceleration: float,
    masses: Sequence[tuple[float, Place]],
    inertias: Sequence[tuple[float, Callable[[mpf], mpf]]],
    forces: Sequence[tuple[complex, Place]],
) -> float:
    total = 0.0
    for mass, place in masses:
        slope, change = rates(place, q, speed, acceleration)
        total += mass * (change * slope.conjugate()).real
    for inertia, turn in inertias:
        slope, change = rates(turn, q, speed, acceleration)
        total += inertia * change.real * slope.real
    for force, place in forces:
        total -= (force * rates(place, q, speed, acceleration)[0].conjugate()).real
    return total


def pump() -> list[object]:
    """Stroke 60, rod 120, bore 50 mm; steel; 500 rpm; SI inside: the file's parameters by hand."""
    r, rod_length, bore, w = 0.03, 0.12, 0.05, 500 * 2 * pi / 60
    area, d = pi * bore**2 / 4, bore / 4
    piston_mass, rod_mass = 7850 * area * bore / 2, 7850 * pi * d**2 / 4 * rod_length

    def piston(t: mpf) -> mpf:
        return r * mp.cos(t) + mp.sqrt(rod_length**2 - (r * mp.sin(t)) ** 2)

    def lean(t: mpf) -> mpf:
        return -mp.asin(r * mp.sin(t) / rod_length)

    def rod(t: mpf) -> mpf:
        return r * mp.expj(t) + rod_length / 2 * mp.expj(lean(t))

    def torque(t: float, pressure: float) -> float:
        inertia = rod_mass * (rod_length**2 / 12 + d**2 / 16)
        forces = [(complex(-pressure * area), piston)]
        return effort(t, w, 0.0, [(piston_mass, piston), (rod_mass, rod)], [(inertia, lean)], forces)

    return [torque(radians(60), 0.0), torque(radians(270), 6e6)]


def engine() -> list[object]:
    """Crank 45, rod 150 mm; 3000 rpm; SI inside."""
    r, rod_length, w, c = 0.045, 0.150, 100 * pi, 0.045
    piston_mass, rod_mass, rod_inertia = 0.45, 0.6, 0.0018

    def piston(t: mpf) -> mpf:
        return r * mp.cos(t) + mp.sqrt(rod_length**2 - (r * mp.sin(t)) ** 2)

    def lean(t: mpf) -> mpf:
        return -mp.asin(r * mp.sin(t) / rod_length)

    def rod(t: mpf) -> mpf:
        return r * mp.expj(t) + c * mp.expj(lean(t))

    def torque(t: float, gas: float) -> float:
        forces = [(complex(-gas), piston)]
        return effort(t, w, 0.0, [(piston_mass, piston), (rod_mass, rod)], [(rod_inertia, lean)], forces)

    def thrust(t: float, gas: float) -> float:
        """Of the cylinder on the piston: moments on the rod about A."""
        x = piston_mass * rates(piston, t, w, 0.0)[1].real + gas
        a, at = rates(rod, t, w, 0.0)[1], complex(lean(t))
        inertia = rod_inertia * rates(lean, t, w, 0.0)[1].real
        arm, centre = rod_length * complex(mp.expj(at)), c * complex(mp.expj(at))
        moment = rod_mass * (centre.conjugate() * a).imag + inertia
        return (moment - arm.imag * x) / arm.real

    full = 22120.0
    return [
        -1000 * r * w**2 * (1 + r / rod_length),
        8240 - piston_mass * r * w**2 * (1 + r / rod_length),
        torque(radians(20), full),
        torque(radians(90), (3850 + 2680) / 2),
        torque(radians(450), -50.0),
        thrust(radians(20), full),
        asin(r / rod_length) * 180 / pi,
    ]


def four_cylinder() -> list[object]:
    """Throw 42.5, rods 138, bore 80 mm; 4000 rpm; pressures off the file; SI inside."""
    r, rod_length, area, w = 0.0425, 0.138, pi * 0.08**2 / 4, 4000 * pi / 30
    rows = (examples()["four_cylinder"].parent / "pressure.csv").read_text(encoding="utf-8").splitlines()[2:]
    bar = {int(a): float(p) for a, p in (row.split(",") for row in rows)}
    throws, later = (0.0, pi, pi, 0.0), (0, 540, 180, 360)

    def piston(t: mpf) -> mpf:
        return r * mp.cos(t) + mp.sqrt(rod_length**2 - (r * mp.sin(t)) ** 2)

    def lean(t: mpf) -> mpf:
        return -mp.asin(r * mp.sin(t) / rod_length)

    def rod(t: mpf) -> mpf:
        return r * mp.expj(t) + 0.3 * rod_length * mp.expj(lean(t))

    def torque(degrees_: int) -> float:
        return sum(
            effort(
                radians(degrees_) + throw,
                w,
                0.0,
                [(0.4, piston), (0.55, rod)],
                [(0.0015, lean)],
                [(complex(-1e5 * bar[(degrees_ - shift) % 720] * area), piston)],
            )
            for throw, shift in zip(throws, later, strict=True)
        )

    at_top = 0.4 * r * w**2 * (1 + r / rod_length)
    return [torque(30), torque(110), torque(330), 1e5 * bar[0] * area - at_top]


def quick_return() -> list[object]:
    """Crank 100, O2 O4 200, lever 500, rod 250, level of the ram 480 above O4, in mm; 40 rpm; SI inside."""
    crank, down, lever, rod, level, w = 0.1, 0.2, 0.5, 0.25, 0.48, 40 * pi / 30

    def swing(t: mpf) -> mpf:
        return mp.pi / 2 - mp.atan(crank * mp.cos(t) / (down + crank * mp.sin(t)))

    def lean(t: mpf) -> mpf:
        return mp.pi - mp.asin((level - lever * mp.sin(swing(t))) / rod)

    def ram(t: mpf) -> mpf:
        return lever * mp.cos(swing(t)) + rod * mp.cos(lean(t))

    def torque(t: float, cutting: float) -> float:
        bodies: list[tuple[float, Place]] = [
            (1.0, lambda t: crank * mp.expj(t)),
            (6.0, lambda t: lever / 2 * mp.expj(swing(t))),
            (2.0, lambda t: lever * mp.expj(swing(t)) + rod / 2 * mp.expj(lean(t))),
            (12.0, ram),
        ]
        weights = [(-1j * G * mass, place) for mass, place in bodies]
        turning = [(0.125 + 0.0004, swing), (0.0104, lean)]
        return effort(t, w, 0.0, bodies, turning, [*weights, (complex(cutting), ram)])

    lift = sqrt(rod**2 - (level - lever * cos(radians(30))) ** 2)
    return [
        1000 * (lever / 2 - lift),
        1000 * (-lever / 2 - lift),
        torque(radians(90), 2000.0),
        torque(radians(150), 2000.0),
        torque(radians(270), 0.0),
    ]


def toggle_press() -> list[object]:
    """Press P = 20 kN, equal links: push 2 P tan(alpha), rod force P / cos(alpha), thrust P tan(alpha)."""
    p = 20000.0
    push = [2 * p * tan(radians(alpha)) for alpha in (30, 10, 2)]
    return [*push, p / cos(radians(10)), [p * tan(radians(10)), 0.0], [p * tan(radians(30)), -p]]


def scissor_lift() -> list[object]:
    """Three stages of 1 m links of 8 kg, platform 40 kg, 3 kN at 0.4 m from the top pin; SI inside."""
    n, load, platform, link = 3, 3000.0, 40 * G, 8 * G

    def drive(width: float) -> float:
        return -(n * (load + platform) + n * n * link) * width / sqrt(1 - width**2)

    def roller(width: float) -> float:
        return (2 * n * link * width / 2 + platform * 0.5 + load * 0.4) / width

    whole = load + platform + 2 * n * link
    return [
        drive(0.96),
        drive(0.8),
        drive(0.6),
        [0.0, roller(0.8)],
        [-drive(0.8), whole - roller(0.8)],
        [0.0, n * 600.0],
    ]


def bucket() -> list[object]:
    """Law of cosines between O, Q and J; polynomial 3-4-5 from 0.6 to 1.15 m in 3 s; SI inside."""
    q, reach, rise, time = complex(0.5, -0.5), 0.9, 0.55, 3.0

    def boom(s: mpf) -> mpf:
        base = abs(q)
        return mp.acos((base**2 + reach**2 - s * s) / (2 * base * reach)) - mp.pi / 4

    def pin(s: mpf) -> mpf:
        return reach * mp.expj(boom(s))

    def cylinder(s: mpf) -> mpf:
        return mp.arg(pin(s) - q)

    def force(u: float) -> float:
        s = 0.6 + rise * (10 * u**3 - 15 * u**4 + 6 * u**5)
        speed = rise / time * 30 * u**2 * (1 - u) ** 2
        acceleration = rise / time**2 * 60 * u * (1 - u) * (1 - 2 * u)
        bodies: list[tuple[float, Place]] = [
            (220.0, lambda s: 1.1 * mp.expj(boom(s))),
            (30.0, lambda s: q + 0.25 * mp.expj(cylinder(s))),
            (20.0, lambda s: pin(s) - 0.28 * mp.expj(cylinder(s))),
        ]
        weights = [(-1j * G * mass, place) for mass, place in bodies]
        earth: tuple[complex, Place] = (-3000j, lambda s: 2.0 * mp.expj(boom(s)))
        turning = [(80.0, boom), (0.7 + 0.55, cylinder)]
        return effort(s, speed, acceleration, bodies, turning, [*weights, earth])

    def lift(s: float) -> float:
        return degrees(acos((0.5 + 0.81 - s * s) / (2 * sqrt(0.5) * 0.9))) - 45

    return [force(0.0), force(0.25), force(0.75), force(1.0), lift(0.6), lift(1.15)]


def two_drives() -> list[object]:
    """The couplers carry forces along themselves: two equations at C, then each crank's moment."""

    def posture(first: float, second: float) -> tuple[complex, float, float]:
        a = 0.15 * complex(cos(first), sin(first))
        b = 0.2 + 0.15 * complex(cos(second), sin(second))
        half, across = (b - a) / 2, 1j * (b - a) / abs(b - a)
        c = a + half + across * sqrt(0.2**2 - abs(half) ** 2)
        u, v = (c - a) / 0.2, (c - b) / 0.2
        tool = complex(20 * cos(first - second), -60)
        det = (u.conjugate() * v).imag
        pushes = -(tool.conjugate() * v).imag / det, -(u.conjugate() * tool).imag / det
        torques = [
            p * (arm.conjugate() * d).imag for p, arm, d in zip(pushes, (a, b - 0.2), (u, v), strict=True)
        ]
        return 1000 * c, torques[0], torques[1]

    values: list[object] = []
    for first, second in ((120, 60), (105, 90), (95, 50)):
        c, t, s = posture(radians(first), radians(second))
        values += [[c.real, c.imag], 1000 * t, 1000 * s]
    return values


def balance_position() -> list[object]:
    """Stationary potential energy: upright, hanging, and where the spring's length is l0 / (1 - W c / (k a h))."""
    ratio = 1.2 * G * 0.3 / (150 * 0.2 * 0.3)
    length = 0.18 / (1 - ratio)
    tilt = degrees(asin((0.2**2 + 0.3**2 - length**2) / (2 * 0.2 * 0.3)))
    turns = [-90.0, tilt, 90.0, 180 - tilt]
    states = ["unstable", "stable", "unstable", "stable"]
    return [4, *(value for pair in zip(turns, states, strict=True) for value in pair)]


def truss() -> list[object]:
    """Method of joints: supports 9.5 and 6.5 kN, then node by node; diagonals rise 3 in 4."""
    left = (6 * 12 + 10 * 8) / 16
    right = 16 - left
    ad, bd, ce = left / 0.6, (left - 6) / 0.6, right / 0.6
    return [
        0,
        [0.0, left],
        [0.0, right],
        [-0.8 * ad, -0.6 * ad],
        [-0.8 * bd, 0.6 * bd],
        ce,
        [0.8 * ce, -0.6 * ce],
        [-0.8 * ce, 0.0],
    ]


def gear_train() -> list[object]:
    """Ratio 1 + 52/20; both meshes give the planet the same tangential force; its pin also turns it round."""
    ratio, sun_radius, centre = 1 + 52 / 20, 0.020, 0.036
    torque = 50 / ratio
    tooth, carrier = torque / sun_radius, 1450 * pi / 30 / ratio
    radial = tooth * tan(radians(20))
    return [
        1,
        1000 * torque,
        carrier,
        carrier * (1 - 52 / 16),
        [-0.2 * carrier**2 * centre, -2 * tooth],
        [radial, tooth],
        [radial, tooth],
    ]


def rssr() -> list[object]:
    """Rocker angle a from |AB| = const.; effort = M q'' + M' q'^2 / 2 + V' - Q by the kinetic energy M q'^2 / 2.

    With r = 40, c = 150, l = 90 mm: (c cos-terms cancel) l^2 + c^2 + r^2 = L^2, so -sin a (c l - r l sin q) = r c sin q
    and the rod, without spin, turns at u x u', u its direction.
    """
    density, r, c, length = mpf("7850"), mpf("0.04"), mpf("0.15"), mpf("0.09")
    rod = mp.sqrt(r**2 + c**2 + length**2)
    crank_mass = density * mpf("0.06") * mpf("0.02") * mpf("0.01")
    rod_mass = density * mp.pi * mpf("0.005") ** 2 * rod
    rocker_mass = density * mp.pi * mpf("0.008") ** 2 * length
    about_o = crank_mass * (mpf("0.06") ** 2 + mpf("0.02") ** 2) / 12 + crank_mass * mpf("0.02") ** 2
    across = rod_mass * (3 * mpf("0.005") ** 2 + rod**2) / 12
    about_c = rocker_mass * (3 * mpf("0.008") ** 2 + length**2) / 12 + rocker_mass * length**2 / 4

    def angle(q: mpf) -> mpf:
        return -mp.asin(r * c * mp.sin(q) / (c * length - r * length * mp.sin(q)))

    def ends(q: mpf) -> tuple[mp.matrix, mp.matrix]:
        a = angle(q)
        at_a = mp.matrix([r * mp.cos(q), r * mp.sin(q), 0])
        return at_a, mp.matrix([0, c - length * mp.sin(a), length * mp.cos(a)])

    def slope(of: Callable[[mpf], mp.matrix], q: mpf) -> mp.matrix:
        return mp.matrix([mp.diff(lambda x, k=k: of(x)[k], q) for k in range(3)])

    def mass(q: mpf) -> mpf:
        middle = slope(lambda x: (ends(x)[0] + ends(x)[1]) / 2, q)
        turning = slope(lambda x: (ends(x)[1] - ends(x)[0]) / rod, q)
        moved, turned = (sum(v**2 for v in of) for of in (middle, turning))
        return about_o + rod_mass * moved + across * turned + about_c * mp.diff(angle, q) ** 2

    def height(q: mpf) -> mpf:
        at_b = ends(q)[1]
        return mpf(G) * (rod_mass + rocker_mass) * at_b[2] / 2

    def torque(degree: int) -> float:
        q, speed = mp.radians(degree), 10 * mp.pi
        inertia = mp.diff(mass, q) * speed**2 / 2
        return float((inertia + mp.diff(height, q) - 2 * mp.diff(angle, q)) * 1000)

    with mp.workdps(60):
        swing = [degrees(angle(mp.radians(d))) for d in (90, 270)]
        rate = float(mp.diff(angle, mp.radians(200)) * 10 * mp.pi)
        return [*swing, rate, torque(30), torque(200), [0, 0, 0]]


EXAMPLES: dict[str, Callable[[], list[object]]] = {
    example.__name__: example
    for example in (
        engine,
        four_cylinder,
        pump,
        quick_return,
        toggle_press,
        scissor_lift,
        bucket,
        two_drives,
        balance_position,
        truss,
        gear_train,
        rssr,
    )
}
