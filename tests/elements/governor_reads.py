"""How the cases of governors, trains and members are read from their files."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import dalembert as da

RPM = math.pi / 30


def watt(m: da.Mechanism) -> Iterator[float]:
    heights = [
        -da.statics(m.with_values({"turning.speed": f"{n} rpm"})).point("arm", "B")[0, 1] for n in (60, 61)
    ]
    yield heights[0]
    yield 1e3 * (heights[0] - heights[1])


def porter(m: da.Mechanism) -> Iterator[float]:
    low, high = (
        da.statics(m.with_values({"drives.O.position": -math.acos(radius / 250)})) for radius in (150, 200)
    )
    yield low.turning_speed[0] / RPM
    yield high.turning_speed[0] / RPM
    yield low.turning_interval[0, 0] / RPM
    yield high.turning_interval[0, 1] / RPM
    g = da.governor(m, range=(-math.acos(0.6), -math.acos(0.8)), count=5)
    assert g.lift == 0.1 or abs(g.lift - 0.1) < 1e-12
    yield g.sensitiveness


def hartnell(m: da.Mechanism) -> Iterator[float]:
    slow, fast = (
        2 * da.statics(m.with_values({"turning.speed": f"{n} rpm"})).unknown_load("spring")
        for n in (290, 310)
    )
    yield slow[0]
    for _ in range(2):  # the arms are at a right angle: their slope changes nothing
        yield fast[1]
        yield (fast[1] - slow[0]) / 15


def rod(m: da.Mechanism) -> Iterator[float]:
    yield da.turning_range(m).bifurcation[0]
    r = da.statics(m)
    stable = r.stability.index("stable")  # type: ignore[union-attr]
    yield 90 + math.degrees(r.drive_position("O")[stable])
    link = {"points": {"O": [0, 0], "B": [0.6, 0]}, "mass": 1, "center": [0.3, 0]}
    tree = {**m.to_tree(), "links": {"ground": {"points": {"O": [0, 0]}}, "rod": link}}
    point = da.statics(da.mechanism(tree))
    yield 90 + math.degrees(point.drive_position("O")[point.stability.index("stable")])  # type: ignore[union-attr]
    yield da.small_swings(r)[0]


def planetary(m: da.Mechanism) -> Iterator[float]:
    r = da.statics(m)
    yield 100 / r.speed("arm")[0]
    yield abs(r.effort("R")[0])
    yield abs(r.unknown_load("load")[0])
    yield da.efficiency(r).forward[0]
    yield da.efficiency(r).reverse[0]
    yield r.power_flow().rolling[0] / r.power_flow().input[0]


def column(m: da.Mechanism) -> Iterator[float]:
    f = da.member_forces(da.statics(m), "beam")
    for factor in (1.0, None, math.pi / 4.493409457909064, 0.5):
        found = f.buckling(length_factor=factor)
        yield found.critical
        yield found.safety
    yield f.buckling().transition


def spun_shaft(m: da.Mechanism) -> Iterator[float]:
    f = da.member_forces(da.dynamics(m), "shaft")
    yield from (abs(f.at(s)["torsion"][0]) for s in (0.0, 0.25, 0.49, 0.75))


def spun_plate(m: da.Mechanism) -> Iterator[float]:
    r = da.dynamics(m)
    yield from (da.member_forces(r, "plate").at(s)["bending"][0] for s in (0.01, 0.1, 0.21, 0.3))
    yield r.effort("O")[0]


def clevis(m: da.Mechanism) -> Iterator[float]:
    x = da.pin(da.statics(m), "A")
    for stress in (x.shear, x.peak_shear, x.eye_pressure, x.cheek_pressure):
        yield stress.max() / 1e6
    yield x.moment.max()
    yield x.bending.max() / 1e6
    yield da.pin(da.statics(m.with_values({"joints.A.pin.planes": 1})), "A").shear.max() / 1e6


READ: dict[str, Callable[[da.Mechanism], Iterator[float]]] = {
    "GOV-11": watt,
    "GOV-12": porter,
    "GOV-14": hartnell,
    "GOV-15": rod,
    "EPI-1": planetary,
    "BUC-1": column,
    "MEM-11": spun_shaft,
    "MEM-12": spun_plate,
    "PIN-1": clevis,
}
