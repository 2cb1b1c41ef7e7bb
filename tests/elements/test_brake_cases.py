"""Published and derived cases of brakes and clutches, by their model files: to 1e-8, and to the source's rounding."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.tiers import tiers

CASES: dict[str, dict[str, Any]] = {
    c["id"]: c for c in json.loads(Path(__file__).with_name("brake_cases.json").read_text(encoding="utf-8"))
}
PSI, LBF, IN, FT, HP = 6894.757293168361, 4.4482216152605, 0.0254, 0.3048, 745.6998715822702
Model = Callable[..., Any]


def simple_band(m: Model) -> Iterator[float]:
    yield abs(da.statics(m()).unknown_load("P")[0]) / LBF
    yield abs(da.statics(m(**{"drives.O.effort": -8400})).unknown_load("P")[0]) / LBF


def car(m: Model) -> Iterator[float]:
    for mu in (0.1, 0.6):
        for rear, front in ((mu, 0), (0, mu), (mu, mu)):
            s = da.simulate(m(rear=rear, front=front), until="100 s")
            yield s.position("R")[-1] / FT


def pivoted(m: Model) -> Iterator[float]:
    found = da.statics(m()).brake("S")
    yield found.torque[0]
    yield found.torque[0] / (found.force[0] * 0.16)


def two_shoes(m: Model) -> Iterator[float]:
    r = da.statics(m())
    first, second = r.shoe("S"), r.shoe("S2")
    yield from (first.pressure[0] / 1e3, first.torque[0], second.pressure[0] / 1e3, second.torque[0])
    yield abs(r.effort("O")[0])


def four_shoes(m: Model) -> Iterator[float]:
    """Two of them turn with the drum, two against it."""
    found, other = (da.statics(m(**{"drives.O.speed": f"{speed} rad/s"})).shoe("S") for speed in (-20, 20))
    yield 1e6 / found.pressure[0] * 1000
    yield 2e6 / found.pressure[0] * (found.torque[0] + other.torque[0])


def lowering(m: Model) -> Iterator[float]:
    r = da.statics(m())
    yield r.brake("S").force[0]
    yield 2.0 / (abs(r.brake("S").slip[0]) * 0.2) * 2.5 * 0.15  # p v = 2 MPa m/s at p = 1 MPa


def shoes_of_shigley(m: Model) -> Iterator[float]:
    r = da.statics(m())
    first, second = r.shoe("S"), r.shoe("S2")
    scale = 1e6 / first.pressure[0]
    yield scale * first.normal_moment[0]
    yield scale * first.friction_moment[0]
    yield scale * 2.2812
    yield scale * first.torque[0]
    yield scale * second.pressure[0] / 1e3
    yield scale * second.torque[0]
    yield scale * abs(r.effort("O")[0])
    yield first.locking_coefficient


def band_lever(m: Model) -> Iterator[float]:
    r = da.statics(m())
    yield abs(r.unknown_load("P")[0])
    yield abs(da.statics(m(**{"drives.O.speed": "10 rad/s", "drives.O.effort": 225})).unknown_load("P")[0])
    yield r.band("band").tight[0]


def blocks(m: Model) -> Iterator[float]:
    s = da.simulate(m(), until="100 s")
    yield s.result.band("band").ratio[0]
    yield abs(s.result.band("band").torque[0])
    yield next(e.time for e in s.events if e.name == "rest")
    yield abs(s.position("O")[-1]) / (2 * np.pi)
    yield -s.works["friction"][-1] / 1e3
    yield s.heat["band"].rise


def caliper(m: Model) -> Iterator[float]:
    found = da.statics(m()).brake("pads")
    yield from (found.pressure[0] / PSI, found.force[0] / LBF, found.friction_radius / IN)
    yield from (found.force_radius / IN, found.oil[0] / PSI)


def block_brake(m: Model) -> Iterator[float]:
    r = da.statics(m())
    yield abs(r.reaction("S")[0][1])
    yield r.unknown_load("P")[0]
    yield da.statics(m(**{"drives.D.speed": "-10 rad/s", "drives.D.effort": -180})).unknown_load("P")[0]
    yield r.brake("S").locking_coefficient
    yield float(np.hypot(*r.reaction("L")[0]))


def collar(m: Model) -> Iterator[float]:
    r = da.statics(m())
    yield r.power_lost("K")[0] / HP


def plates(m: Model) -> Iterator[float]:
    r = da.statics(m())
    found = r.brake("K")
    yield from (found.force[0], found.torque[0], r.power_lost("K")[0] / 1e3)


def flying(m: Model) -> Iterator[float]:
    """The torque of a shoe of 1 kg on a spring that just holds it at 500 rpm."""
    hold = 0.14 * (500 * np.pi / 30) ** 2
    r = da.dynamics(m(**{"loads.spring.value": [-hold, 0.0]}))
    yield 20e3 / (750 * np.pi / 30) / (4 * r.brake("S").torque[0])


def faces(m: Model) -> Iterator[float]:
    for law in ("wear", "pressure"):
        found = da.statics(m(**{"joints.K.law": law})).brake("K")
        yield from (found.force_for("1 MPa"), found.torque_for("1 MPa"))
        yield found.torque_for("1 MPa") * 500 * np.pi / 30 / 1e3


def engagement(m: Model) -> Iterator[float]:
    s = da.simulate(m(), until="5 s")
    stick = next(e.time for e in s.events if e.of == "K")
    yield stick
    yield float(np.interp(stick, s.time, s.speed("B")))
    yield -s.works["friction"][-1]
    yield abs(s.result.friction_moment("K")[-1])
    free = da.simulate(m(**{"drives.A.effort": 0, "drives.B.effort": 0}), until="5 s")
    yield -free.works["friction"][-1]


READ: dict[str, Callable[[Model], Iterator[float]]] = {
    "BRK-1": simple_band,
    "BRK-3": car,
    "BRK-4": pivoted,
    "BRK-5": two_shoes,
    "BRK-7": four_shoes,
    "BRK-8": lowering,
    "BRK-11": shoes_of_shigley,
    "BRK-13": band_lever,
    "BRK-15": blocks,
    "BRK-16": caliper,
    "BRK-18": block_brake,
    "CLU-1": collar,
    "CLU-3": plates,
    "CLU-4": flying,
    "CLU-11": faces,
    "CLU-13": engagement,
}


@pytest.mark.parametrize("case", tiers([c for c in READ if c != "BRK-3"], ["BRK-3"]))
def test_case(case: str) -> None:
    described = da.loads(CASES[case]["file"])

    def model(**values: object) -> Any:
        return described.with_values({path: as_text(path, value) for path, value in values.items()})

    found, quantities = list(READ[case](model)), CASES[case]["quantities"]
    assert len(found) == len(quantities)
    for value, q in zip(found, quantities, strict=True):
        assert value == pytest.approx(q["exact"], rel=1e-8, abs=1e-12), q["name"]
        if "printed" in q:
            assert value == pytest.approx(q["printed"], rel=q["tolerance"]), q["name"]


def as_text(path: str, value: object) -> object:
    """A bare effort is in the file's unit of moments."""
    return str(value) if path.endswith("effort") else value


def test_every_case_is_read() -> None:
    assert CASES.keys() == READ.keys()
