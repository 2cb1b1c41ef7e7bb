"""What a whole sheet earns, beside what a teacher gives by hand: behaviours of students on a four-bar, four marks."""

from __future__ import annotations

import cmath
import csv
import math
from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da

MODEL = """
dalembert: 1
units: {length: mm, force: N, mass: kg, angle: deg, moment: N*m, inertia: kg*m^2}
gravity: standard
links:
  ground: {points: {O2: [0, 0], O4: [320, 0]}}
  crank: {points: {O2: [0, 0], A: [100, 0]}, mass: 1, center: [50, 0], inertia: 0.002}
  coupler: {points: {A: [0, 0], B: [300, 0], P: [200, 60]}, mass: 3, center: [130, 40], inertia: 0.03}
  rocker: {points: {O4: [0, 0], B: [200, 0]}, mass: 2, center: [90, 0], inertia: 0.01}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives:
  O2: {position: 60, speed: 300 rpm, acceleration: -100 rad/s^2}
loads:
  F: {type: force, on: coupler, at: P, value: 800 @ 330}
  T_4: {type: couple, on: rocker, value: 60}
assembly: {coupler: 20, rocker: 100}
"""
JOINTS = "O2", "A", "B"
ASKED = "effort.O2", *(f"reaction.{j}" for j in JOINTS)
Figures = dict[str, Any]


def figures(m: da.Mechanism, **changed: Any) -> Figures:
    """The torque and the joint forces, as complex numbers, of the mechanism with other data."""
    r = da.solve(m.with_values({k.replace("__", "."): v for k, v in changed.items()}))
    forces = {j: complex(*np.ravel(r[f"reaction.{j}"])[:2]) for j in JOINTS}
    return forces | {"T": float(r["effort.O2"][0])}


def polar(force: complex, turn: float = 1, whole: bool = False) -> str:
    angle = turn * math.degrees(cmath.phase(force))
    return f"{abs(force):.1f} ∠ {angle % 360 if whole else angle:.1f}°"


def sheet(some: Figures, **others: str) -> dict[str, str]:
    cells = {f"reaction.{j}": polar(some[j]) for j in JOINTS} | {"effort.O2": f"{some['T']:.2f} N*m"}
    return cells | {("effort.O2" if k == "T" else f"reaction.{k}"): v for k, v in others.items()}


def carried(right: Figures, error: complex, at_b: bool) -> Figures:
    """A slip in the force at A or at B, and what is right by it: coupler, crank, moments about O2."""
    torque = (0.1 * cmath.exp(-1j * math.pi / 3) * error).imag
    slipped = {"A": error, "O2": error, "T": torque} | ({"B": error} if at_b else {})
    return {name: value + slipped.get(name, 0) for name, value in right.items()}


def test_behaviours_earn_what_a_teacher_gives_within_half_a_mark(tmp_path: Path) -> None:
    (tmp_path / "four_bar.yaml").write_text(MODEL, encoding="utf-8")
    m = da.load(tmp_path / "four_bar.yaml")
    right = figures(m)
    rest = {"drives__O2__speed": "0 rad/s", "drives__O2__acceleration": "0 rad/s^2"}
    off = np.random.default_rng(3).uniform(-0.02, 0.02, (2, 4))
    drawn = {name: v * (1 + off[0][k]) for k, (name, v) in enumerate(right.items())}
    drawn |= {j: drawn[j] * cmath.exp(1j * off[1][k]) for k, j in enumerate(JOINTS)}
    fractions = {j: f"{right[j].real:.1f}; {right[j].imag:.1f}".replace(".", ",") for j in JOINTS}
    rows: list[tuple[str, tuple[float, float], dict[str, str]]] = [
        ("right", (4, 4), sheet(right)),
        ("components with decimal commas", (4, 4), sheet(right, **fractions)),
        ("directions from 0 to 360", (4, 4), sheet(right, A=polar(right["A"], whole=True))),
        ("sense in words", (4, 4), sheet(right, T=f"{right['T']:.2f} Nm ccw")),
        ("nothing", (0, 0), {}),
        ("two figures", (2, 2), dict(list(sheet(right).items())[:2])),
        ("slip at B carried on", (3, 3), sheet(carried(right, 80 + 30j, True))),
        ("slip at A carried on", (3, 3), sheet(carried(right, -45j, False))),
        ("torque wrong", (3, 3), sheet(right, T="61.3 N*m")),
        ("sizes only", (3, 3), sheet(right, **{j: f"{abs(right[j]):.1f}" for j in JOINTS})),
        ("sense of the torque", (3.5, 3.5), sheet(right, T=f"{-right['T']:.2f} N*m")),
        ("torque in N mm", (3.5, 3.5), sheet(right, T=f"{1000 * right['T']:.0f} N*m")),
        ("forces on the other link", (3.5, 3.5), sheet(right | {j: -right[j] for j in JOINTS})),
        ("angles clockwise", (3.5, 3.5), sheet(right, **{j: polar(right[j], -1) for j in JOINTS})),
        ("no gravity", (1.5, 2.5), sheet(figures(m, gravity="none"))),
        ("no inertia", (1.5, 2.5), sheet(figures(m, **rest))),
        ("rpm for rad/s", (1.5, 2.5), sheet(figures(m, drives__O2__speed="300 rad/s"))),
        ("crank at 70 deg", (1.5, 2.5), sheet(figures(m, drives__O2__position="70 deg"))),
        ("couple reversed", (1.5, 2.5), sheet(figures(m, loads__T_4__value="-60 N*m"))),
        ("drawn, 2 % off", (3.5, 3.5), sheet(drawn)),
    ]  # fmt: skip
    with (tmp_path / "class.csv").open("w", newline="", encoding="utf-8") as out:
        table = csv.DictWriter(out, ["student", *ASKED])
        table.writeheader()
        table.writerows({"student": name, **cells} for name, _, cells in rows)
    key = tmp_path / "key.csv"
    asked = "".join("1,four_bar.yaml,{},{},1\n".format(*name.split(".")) for name in ASKED)
    key.write_text("variant,file,quantity,of,marks\n" + asked, encoding="utf-8")
    marks = {s.student: s.total for s in da.grade(tmp_path / "class.csv", key).students}
    assert len(marks) == len(rows)
    unfair = {n: marks[n] for n, (low, high), _ in rows if not low - 0.5 <= marks[n] <= high + 0.5}
    assert unfair == {}
    assert [n for n, (low, high), _ in rows if low == high in (0, 2, 4) and marks[n] != low] == []
