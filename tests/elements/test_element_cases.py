"""Visible cases of machine elements, by their model files: to 1e-8 of the exact value, to the source's rounding."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from tests.elements import governor_reads

CASES: dict[str, dict[str, Any]] = {
    c["id"]: c for c in json.loads(Path(__file__).with_name("element_cases.json").read_text(encoding="utf-8"))
}
Read = Callable[[da.Mechanism], Iterator[float]]


def cylinder_column(m: da.Mechanism) -> Iterator[float]:
    for ends in (["pin", "pin"], ["fixed", "free"], ["fixed", "pin"]):
        yield da.statics(m.with_values({"drives.C.cylinder.ends": ends})).cylinder("C").critical[0] / 1e3
    found = da.statics(m).cylinder("C")
    yield found.critical_rod[0] / 1e3
    yield found.critical_barrel[0] / 1e3


def cylinder_boom(m: da.Mechanism) -> Iterator[float]:
    def at(values: Mapping[str, object]) -> da.Result:
        return da.statics(m.with_values(values))

    r = da.statics(m)
    yield 1e3 * r.drive_position("C")[0]
    yield r.effort("C")[0] / 1e3
    yield r["pressure.C"][0] / 1e5
    moving = at({"drives.C.speed": "60 mm/s"})
    yield moving.cylinder("C").flow_in[0] * 6e4
    yield moving.cylinder("C").flow_out[0] * 6e4
    yield moving.speed("boom")[0]
    for speed in ("60 mm/s", "-60 mm/s"):
        lossy = at({"drives.C.cylinder.efficiency": 0.94, "drives.C.speed": speed})
        yield lossy.cylinder("C").pressure[0] / 1e5


def geared_motor(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, until="20 s")
    final = s.speed("O")[-1]
    risen = da.simulate(m, until=f"O.speed = {0.9 * 17.766203703703702} rad/s")
    yield from (final, risen.time[-1], risen.position("O")[-1], s.acceleration("O")[0])
    yield from (s.motor["O"].gear_torque[0], s.motor["O"].loss[-1])


def power_screw(m: da.Mechanism) -> Iterator[float]:
    up, down = (da.statics(m.with_values({"drives.S.speed": v})).screw("S") for v in ("10 mm/s", "-10 mm/s"))
    bare = da.statics(m.with_values({"drives.S.speed": "-10 mm/s", "drives.S.screw.collar.coefficient": 0}))
    yield from (up.torque[0], -down.torque[0], up.efficiency[0], -bare.screw("S").torque[0])


def wedge(m: da.Mechanism) -> Iterator[float]:
    r = da.statics(m)
    phi = math.atan(0.18)
    yield r.effort("floor")[0]
    yield -da.statics(m.with_values({"drives.floor.speed": "-0.1 m/s"})).effort("floor")[0]
    yield math.degrees(2 * phi)
    yield da.efficiency(r).forward[0]
    yield 90 - math.degrees(2 * phi)


def roller_clutch(m: da.Mechanism) -> Iterator[float]:
    x = da.statics(m).one_way("K")
    yield from (x.least_coefficient, x.roller_force[0], x.torque_for("2500 N"))


def pawl_and_ratchet(m: da.Mechanism) -> Iterator[float]:
    x = da.statics(m).one_way("K")
    yield from (x.pawl_force[0], math.degrees(x.friction_angle), math.degrees(x.pitch))


def motion_curves(m: da.Mechanism) -> Iterator[float]:
    for by in (
        "harmonic",
        "cycloidal",
        "polynomial345",
        "polynomial4567",
        "modified_sine",
        "modified_trapezoid",
    ):
        yield from da.law(m, "S", by=by).coefficients.values()


def law_of_a_master(m: da.Mechanism) -> Iterator[float]:
    r = da.dynamics(m)
    for k in range(4):
        yield from (1e3 * r.drive_position("S")[k], r.drive_speed("S")[k], r.drive_acceleration("S")[k])


def servo_motion(m: da.Mechanism) -> Iterator[float]:
    law = da.law(m, "S")
    yield from (law.times[1], law.times[3], law.duration, *law.at(0.25)[:3])
    shorter = [
        da.law(da.loads(CASES["LAW-4"]["file"].replace("0.5 m,", f"{h} m,")), "S") for h in (0.12, 0.02)
    ]
    yield from (shorter[0].duration, shorter[0].peak_speed, shorter[1].duration)


def polynomial_to_a_speed(m: da.Mechanism) -> Iterator[float]:
    law = da.law(m, "S")
    yield 1e3 * law.at(0.125)[0]
    yield from (max(law.acceleration), min(law.acceleration), law.at(0.0)[3], 1e3 * law.at(0.35)[0])


READ: dict[str, Read] = {
    **governor_reads.READ,
    "LAW-1": motion_curves,
    "LAW-3": law_of_a_master,
    "LAW-4": servo_motion,
    "LAW-6": polynomial_to_a_speed,
    "CYL-1": cylinder_column,
    "CYL-2": cylinder_boom,
    "MTR-1": geared_motor,
    "SCR-1": power_screw,
    "WED-1": wedge,
    "RAT-1": roller_clutch,
    "RAT-3": pawl_and_ratchet,
}


@pytest.mark.parametrize("case", CASES)
def test_case(case: str) -> None:
    found = list(READ[case](da.loads(CASES[case]["file"])))
    quantities = CASES[case]["quantities"]
    assert len(found) == len(quantities)
    for value, q in zip(found, quantities, strict=True):
        assert value == pytest.approx(q["exact"], rel=1e-8, abs=1e-12), q["name"]
        if "printed" in q:
            assert value == pytest.approx(q["printed"], rel=q["tolerance"]), q["name"]
