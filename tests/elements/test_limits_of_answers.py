"""Cylinders and laws of motion in numbers: safeties, vacuum, chambers, rises of each form, what is printed of a law."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.elements.cylinder_answer import ATMOSPHERE, CylinderAnswer, _working
from dalembert.machine.elements.stepped_column import FORMS, critical_load, euler
from dalembert.machine.motion_law import programme_of
from dalembert.printing import number

UNKNOWN: Any = None


def answer(force: Any, **more: Any) -> CylinderAnswer:
    none = np.full(len(force), np.nan)
    names = (
        "length speed force cap_pressure rod_pressure pressure pressure_low pressure_high flow_in flow_out"
    )
    given = dict.fromkeys([*names.split(), "critical", "critical_rod", "critical_barrel"], none)
    rows = {k: np.array(x, float) for k, x in ({"force": force} | more).items()}
    return CylinderAnswer(name="C", **(given | rows))


def test_a_cylinder_that_pulls_does_not_buckle() -> None:
    c = answer([200.0, -50, 0, 400, 250], critical=[1000, 1000, 1000, 1200, 750], speed=[2, 3, 0, -1, 0.5])
    assert c.safety.tolist() == [5.0, math.inf, math.inf, 3.0, 3.0]
    assert c.worst == 3
    assert c.power.tolist() == [400, -150, 0, -400, 125]
    assert answer([200.0, 300], critical=[np.nan, 900]).worst == 1
    assert answer([200.0, 300], critical=[np.nan, np.nan]).worst == 0


def test_a_vacuum_is_less_than_no_pressure_in_either_chamber() -> None:
    low = -ATMOSPHERE
    cap, rod = [low * 1.01, low * 0.99, 0, 1e5, np.nan], [0, 0, low * 1.01, 1e5, low * 1.01]
    found = answer([1.0] * 5, cap_pressure=cap, rod_pressure=rod).vacuum
    assert found.tolist() == [True, False, True, False, True]


@pytest.mark.parametrize(
    ("cap", "rod", "works"), [(None, None, [5, 7]), (3e5, None, [4, 7]), (None, 3e5, [5, 6])]
)
def test_the_chamber_that_works_is_the_one_that_is_not_given(cap: Any, rod: Any, works: Any) -> None:
    c: Any = SimpleNamespace(cap_pressure=cap, rod_pressure=rod)
    found = _working(c, np.array([5.0, 6]), np.array([4.0, 7]))
    assert found.tolist() == works


LINKS = {"ground": {"points": {"A": [0, 0], "G": [0, 0]}}, "ram": {"points": {"B": [0, 0]}, "mass": 2}}
GUIDE = {"type": "slider", "links": ["ground", "ram"], "at": ["G", "B"]}


@pytest.mark.parametrize("speed", [0.2, -0.3])
@pytest.mark.parametrize("force", [7000.0, -4000.0])
def test_pressures_and_flows_of_a_cylinder_follow_from_its_areas(speed: float, force: float) -> None:
    """A push of the rod is borne at the cap, a pull at the rod's side; oil goes in where the chamber grows."""
    drive = {
        "cylinder": {"between": ["ground.A", "ram.B"], "bore": 0.1, "rod": 0.06},
        "position": 1.0,
        "speed": speed,
    }
    load = {"type": "force", "on": "ram", "at": "B", "value": [-force, 0]}
    m = da.mechanism(
        {
            "gravity": "none",
            "links": LINKS,
            "joints": {"G": GUIDE},
            "drives": {"C": drive},
            "loads": {"F": load},
        }
    )
    c = da.statics(m).cylinder("C")
    cap, ring = math.pi / 4 * 0.01, math.pi / 4 * (0.01 - 0.0036)
    assert c.force == pytest.approx([force])
    assert c.cap_pressure == pytest.approx([max(force, 0) / cap])
    assert c.rod_pressure == pytest.approx([max(-force, 0) / ring])
    assert c.pressure == pytest.approx([force / cap if force > 0 else -force / ring])
    assert c.pressure_low == pytest.approx(c.pressure)
    assert c.pressure_high == pytest.approx(c.pressure)
    into, out = (cap, ring) if speed > 0 else (ring, cap)
    assert (c.flow_in, c.flow_out) == (pytest.approx([into * abs(speed)]), pytest.approx([out * abs(speed)]))  # type: ignore[comparison-overlap]
    assert c.power == pytest.approx([force * speed])
    assert (c.length.tolist(), c.speed.tolist()) == ([1.0], [speed])
    with pytest.raises(da.ModelError, match="drive 'D' is not a cylinder"):
        da.statics(m).cylinder("D")


@pytest.mark.parametrize("ends", [*FORMS])
@pytest.mark.parametrize(
    ("l1", "l2", "e1", "e2"), [(0.7, 1.3, 9.0, 4.0), (1.3, 0.7, 2.0, 5.0), (0.4, 0.5, 6.0, 60.0)]
)
def test_a_stepped_column_buckles_at_the_first_root_of_its_form(
    ends: tuple[str, str], l1: float, l2: float, e1: float, e2: float
) -> None:
    """Between the loads of both sections all along; below it the form has one sign."""
    load = critical_load(l1, l2, e1, e2, ends)
    low, high = sorted(euler(l1 + l2, e, ends) for e in (e1, e2))
    assert low < load < high
    form = FORMS[ends](l1, l2, e1, e2)
    below = form(np.linspace(0.5 * low, load * (1 - 1e-6), 400))
    assert (np.sign(below) == np.sign(below[0])).all()
    assert np.sign(form(load * (1 + 1e-6))) == -np.sign(below[0])
    assert critical_load(l1 + l2, 0.0, e1, e2, ends) == pytest.approx(euler(l1 + l2, e1, ends))
    assert critical_load(0.0, l1 + l2, e1, e2, ends) == pytest.approx(euler(l1 + l2, e2, ends))
    assert critical_load(l1, l2, e1, e1, ends) == pytest.approx(euler(l1 + l2, e1, ends))
    factor = {("pin", "pin"): 1.0, ("fixed", "free"): 2.0, ("fixed", "pin"): 0.69915566}[ends]
    assert euler(2.0, 9.0, ends) == pytest.approx(math.pi**2 * 9 / (2 * factor) ** 2, rel=1e-7)


def ram(law: Any) -> Any:
    slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    links = {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"F": [0, 0]}}}
    return da.mechanism({"links": links, "joints": slide, "drives": {"S": {"law": law}}})


SEGMENTS = [
    {"to": 0.02, "in": 0.2, "by": "cycloidal"},
    {"dwell": 0.1},
    {"to": 0.05, "in": 0.4, "by": "harmonic"},
    {"to": 0.0, "in": 0.3, "by": "cycloidal"},
]


def test_rises_of_a_law_begin_where_the_one_before_has_ended() -> None:
    """C_v = 2 and C_a = 2 pi of a cycloid, pi / 2 and pi^2 / 2 of a half wave; a dwell is no rise."""
    law = da.law(ram({"segments": SEGMENTS, "count": 11}), "S")
    assert [x.by for x in law.rises] == ["cycloidal", "harmonic", "cycloidal"]
    rows = [(x.start, x.way, x.length) for x in law.rises]
    assert np.array(rows) == pytest.approx(np.array([(0, 0.02, 0.2), (0.3, 0.03, 0.4), (0.7, -0.05, 0.3)]))
    pi = math.pi
    for rise, (v, a, j) in zip(
        law.rises, ((2, 2 * pi, 4 * pi**2), (pi / 2, pi**2 / 2, pi**3 / 2)), strict=False
    ):
        assert [*rise.coefficients.values()] == pytest.approx([v, a, j])
        assert [*rise.coefficients] == ["C_v", "C_a", "C_j"]
    assert law.coefficients == law.rises[0].coefficients
    assert law.times == pytest.approx([0, 0.2, 0.3, 0.7, 1.0])
    assert law.duration == pytest.approx(1.0)
    other = da.law(ram({"segments": SEGMENTS, "count": 11}), "S", by="harmonic")
    assert [x.by for x in other.rises] == ["harmonic"] * 3
    assert other.peak_speed == pytest.approx(max(0.02 / 0.2, 0.03 / 0.4, 0.05 / 0.3) * pi / 2)


def test_the_record_and_the_text_of_a_law_have_its_peaks_with_their_places() -> None:
    law = da.law(ram({"segments": SEGMENTS, "count": 11}), "S")
    pi = math.pi
    found = law.record(da.statics(ram({"segments": SEGMENTS, "count": 11})).scale("SI"))["law"]
    assert (found["drive"], found["over"]) == ("S", "time")
    assert found["peaks"]["speed"]["peak"] == pytest.approx(2 * 0.05 / 0.3)
    assert found["peaks"]["speed"]["at"] == pytest.approx(0.85)
    assert found["peaks"]["acceleration"]["peak"] == pytest.approx(2 * pi * 0.05 / 0.09)
    assert found["peaks"]["jerk"]["peak"] == pytest.approx(4 * pi**2 * 0.02 / 0.008)  # of the first
    text = law.text()
    assert "Law of S over time, 1 s long." in text
    rows = [line.split() for line in text.splitlines()]
    speed = next(row for row in rows if row and row[0] == "speed")
    assert speed[1:] == [number(2 * 0.05 / 0.3), "m/s", "0.85", "s"]
    rise = next(row for row in rows if row and row[0] == "harmonic")
    assert rise[1:] == ["0.3", "0.03", "0.4", *(number(x) for x in (pi / 2, pi**2 / 2, pi**3 / 2))]
    assert "The acceleration jumps at 0.3, 0.7 s." in text


def test_instants_of_a_law_have_its_joints_and_extremes() -> None:
    law = da.law(ram({"segments": SEGMENTS[:2], "count": 4}), "S")
    times = next(iter(law.columns())).values
    assert {0.0, 0.1, 0.2, 0.3} <= {*times.round(9)}
    assert law.position[-1] == pytest.approx(0.02)
    assert law.speed.max() == pytest.approx(0.2)
    assert [c.name for c in law.columns()] == [
        "time",
        "drive.S",
        "drive.S.speed",
        "drive.S.acceleration",
        "drive.S.jerk",
    ]
    assert [c.kind for c in law.columns()][:3] == ["time", "length", "speed"]


def test_other_laws_are_programmes_too() -> None:
    rise = {"type": "harmonic", "from": 0.1, "to": 0.4, "duration": "2 s", "count": 5}
    law = da.law(ram(rise), "S")
    assert [(x.by, x.start, x.length) for x in law.rises] == [("harmonic", 0.0, 2.0)]
    assert law.rises[0].way == pytest.approx(0.3)
    assert law.at(1.0)[:2] == pytest.approx([0.25, 0.3 / 2 * math.pi / 2])
    table = {"type": "table", "time": [1, 2, 4, 5], "position": [0.3, 0.5, 0.1, 0.2], "count": 5}
    curve = da.law(ram(table), "S")
    assert curve.rises == ()
    assert curve.coefficients == {}
    assert curve.duration == pytest.approx(4.0)
    m = ram(rise)
    assert programme_of(m.drives["S"].model_copy(update={"law": None})) is None
    for drive, by, said in (
        ("T", None, "unknown drive 'T'"),
        ("S", "straight", "unknown motion curve 'straight'"),
    ):
        with pytest.raises(da.ModelError, match=said):
            da.law(m, drive, by)
    still = da.slider_crank()
    with pytest.raises(da.ModelError, match="drive 'O2' has no law of motion"):
        da.law(still, "O2")
