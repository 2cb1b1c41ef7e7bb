"""Torsion springs count whole turns by a rule that no list of positions changes, in every way of computing."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import pytest

import dalembert as da
from tests.random_space.drawing import Array

ENDS = {
    "O2": ("ground", "crank"),
    "A": ("crank", "coupler"),
    "B": ("coupler", "rocker"),
    "O4": ("ground", "rocker"),
}
TURN = 360.0
CRANK = np.arange(-720.0, 1081.0, 5.0)


class FourBar(NamedTuple):
    """Lengths, the angles (deg) that ``assembly`` states, and free angles of springs of 10 N m/rad."""

    crank: float
    coupler: float
    rocker: float
    ground: float
    stated: dict[str, float]
    free: dict[str, float]
    side: int = 1

    def mechanism(self, positions: Any) -> da.Mechanism:
        loads = {
            f"spring {joint}": {"type": "torsion_spring", "joint": joint, "stiffness": 10, "free_angle": free}
            for joint, free in self.free.items()
        }
        points = {
            "ground": {"O2": [0, 0], "O4": [self.ground, 0]},
            "crank": {"O2": [0, 0], "A": [self.crank, 0]},
            "coupler": {"A": [0, 0], "B": [self.coupler, 0]},
            "rocker": {"O4": [0, 0], "B": [self.rocker, 0]},
        }
        return da.mechanism(
            {
                "dalembert": 1,
                "links": {link: {"points": found} for link, found in points.items()},
                "joints": {joint: {"type": "pin", "links": list(ends)} for joint, ends in ENDS.items()},
                "drives": {"O2": {"position": positions}},
                "loads": loads,
                "assembly": self.stated,
            }
        )

    def turns(self, joint: str) -> dict[int, tuple[float, float]]:
        """Angle of a joint (deg) and its rate with the crank, by every fifth degree of the crank: circles that cut."""
        q, angle = CRANK, self.angles()
        i, j = ENDS[joint]
        phi = angle[j] - angle[i]
        at = self.stated.get("crank", 0.0)
        start = int(np.flatnonzero(q == at)[0])
        phi = phi - TURN * np.ceil((phi[start] - self.near(joint, start)) / TURN - 0.5)
        rate = _rates(self, q, angle)
        return {int(a): (float(x), float(y)) for a, x, y in zip(q, phi, rate[j] - rate[i], strict=True)}

    def angles(self) -> dict[str, Array]:
        return _closed(*self[:4], self.side)

    def near(self, joint: str, start: int) -> float:
        """What the joint's angle is within half a turn of."""
        i, j = ENDS[joint]
        if i not in self.stated and j not in self.stated:
            return 0.0
        known = {"ground": 0.0, "crank": float(CRANK[start])} | self.stated
        angles = {link: angle[start] for link, angle in self.angles().items()}
        own = {link: angle - TURN * np.ceil(angle / TURN - 0.5) for link, angle in angles.items()}
        return known.get(j, own[j]) - known.get(i, own[i])

    def effort(self, position: int) -> float:
        """Moment of the crank by virtual work: the springs' moments at the rates of their joints."""
        total = 0.0
        for joint, free in self.free.items():
            phi, rate = self.turns(joint)[position]
            total += 10 * np.radians(phi - free) * rate
        return total


@lru_cache
def _closed(crank: float, coupler: float, rocker: float, ground: float, side: int) -> dict[str, Array]:
    """Angles of the links (deg) with B on one side of the line from A to O4, followed through whole turns."""
    a = crank * np.exp(1j * np.radians(CRANK))
    d = ground - a
    along = (np.abs(d) ** 2 + coupler**2 - rocker**2) / (2 * np.abs(d))
    b = a + d / np.abs(d) * (along + side * 1j * np.sqrt(coupler**2 - along**2))
    followed = (np.degrees(np.unwrap(np.angle(v))) for v in (b - a, b - ground))
    return {"ground": 0.0 * CRANK, "crank": CRANK, **dict(zip(("coupler", "rocker"), followed, strict=True))}


def _rates(f: FourBar, q: Array, angle: dict[str, Array]) -> dict[str, Array]:
    two, three, four = (np.radians(angle[link]) for link in ("crank", "coupler", "rocker"))
    down = np.sin(four - three)
    return {
        "ground": 0.0 * q,
        "crank": 1.0 + 0.0 * q,
        "coupler": f.crank * np.sin(two - four) / (f.coupler * down),
        "rocker": f.crank * np.sin(two - three) / (f.rocker * down),
    }


WOUND = {"A": -200.0, "B": 300.0, "O4": -120.0}
FOUR_BARS = {
    "oscillating, as stated": FourBar(1, 4, 3, 4, {"coupler": 20, "rocker": 100}, WOUND),
    "a turn more": FourBar(1, 4, 3, 4, {"coupler": 20, "rocker": 460}, WOUND),
    "one of both stated": FourBar(1, 4, 3, 4, {"rocker": 100}, WOUND),
    "drag link, crank stated too": FourBar(
        3, 3.5, 3.2, 1, {"crank": 200, "coupler": 90, "rocker": 220}, WOUND
    ),
    "drag link, two turns more": FourBar(
        3, 3.5, 3.2, 1, {"crank": 200, "coupler": 450, "rocker": 940}, WOUND
    ),
}


CASES = [
    ("oscillating, as stated", 0),
    ("drag link, two turns more", 1),
    *(pytest.param(name, seed, marks=pytest.mark.long) for name in FOUR_BARS for seed in range(2, 14)),
]


@pytest.mark.parametrize(("name", "seed"), CASES)
def test_springs_of_a_four_bar_whatever_positions_are_asked(name: str, seed: int) -> None:
    """Any positions over five turns, in any order: analyses, kernel and space have the moment of virtual work."""
    f, rng = FOUR_BARS[name], np.random.default_rng(seed)
    for count in (1, 6):
        places = rng.choice(CRANK, count, replace=False).tolist()
        m = f.mechanism(places)
        r = da.statics(m)
        side = np.sign(np.sin(r.angle("rocker") - r.angle("coupler")))
        on = f._replace(
            side=int(side[0])
        )  # which way of closing is nearest to what is stated at the first position
        expected = [on.effort(int(q)) for q in places]
        assert (side == on.side).all()
        assert r.effort("O2") == pytest.approx(expected, rel=1e-9)
        assert da.compile(m)().effort("O2")[0] == pytest.approx(expected, rel=1e-9)
        assert da.statics(da.lifted(m)).effort("O2") == pytest.approx(expected, rel=1e-8)
        for joint in f.free:
            turn = r.freedom(joint, "turn")[0]
            assert np.degrees(turn) == pytest.approx([on.turns(joint)[int(q)][0] for q in places])


def _issue(**more: Any) -> da.Mechanism:
    """A crank-rocker whose rocker is preloaded by more than half a turn."""
    f = FourBar(1, 4, 3, 4, {"coupler": 20, "rocker": 100}, {"O4": -120})
    return f.mechanism(90).with_values(more)


def test_a_preload_above_half_a_turn() -> None:
    m = _issue()
    for r in (da.statics(m), da.statics(da.lifted(m))):
        assert r.effort("O2") == pytest.approx([11.83092928633], rel=1e-10)
    assert da.compile(m)().effort("O2") == pytest.approx(11.83092928633, rel=1e-10)


def test_the_answer_says_how_turns_were_counted() -> None:
    r = da.statics(_issue())
    said = (
        "99.8064 deg at O2 = 90 deg, counted to within half a turn of 100 deg of the assembly at O2 = 0 deg"
    )
    other = " (not -260.194 deg or 459.806 deg, which the angles in `assembly` choose)"
    assert r.assumptions["turn of O4 for spring O4"] == said + other
    told = r.to_dict()
    assert told["counted_turns"]["spring O4"] == {
        "joint": "O4",
        "freedom": "turn",
        "within_half_a_turn_of": pytest.approx(np.radians(100)),
        "stated": True,
        "two_readings": True,
    }
    assert told["positions"][0]["spring_turns"]["spring O4"] == pytest.approx(1.7419501646)
    near = da.statics(_issue(**{"loads.spring O4.free_angle": 0.5}))
    assert near.assumptions["turn of O4 for spring O4"] == said
    assert near.to_dict()["counted_turns"]["spring O4"]["two_readings"] is False


def test_designs_that_count_another_turn_are_told_apart_in_the_kernel() -> None:
    """The rocker of a drag link stands 1 deg within half a turn of what is stated; other couplers put it beyond."""
    f = FourBar(3, 3.5, 3.2, 1, {"crank": 0}, {"O4": 30, "A": -20})
    angle = f.angles()["rocker"][CRANK == 0][0]
    f = f._replace(stated={"crank": 0, "rocker": float(angle) + 179})
    m = f.mechanism([175, 180, 200])
    lengths = np.linspace(3.4, 3.6, 9)
    designs = [m.with_values({"links.coupler.points.B": (float(x), 0.0)}) for x in lengths]
    expected = [da.statics(design) for design in designs]
    turns = np.array([r.freedom("O4", "turn")[0] for r in expected])
    assert np.ptp(turns) > np.pi
    r = da.compile(m, ["links.coupler.points.B.0"])(lengths)
    assert r.effort("O2") == pytest.approx(np.array([r.effort("O2") for r in expected]), rel=1e-9)
    assert 0 < r.redone < len(lengths)
    told = da.compile(m, ["assembly.rocker"])(
        [f.stated["rocker"] * np.pi / 180 + turn for turn in (0, 2 * np.pi)]
    )
    more = da.statics(m.with_values({"assembly.rocker": np.radians(f.stated["rocker"]) + 2 * np.pi}))
    assert told.effort("O2")[1] == pytest.approx(more.effort("O2"), rel=1e-9)


ROCKER = FourBar(3, 3.5, 1.2, 4, {}, {"A": 40, "B": 300, "O4": -120})


LISTS = [[40], [320], [70, 40, 320, 300]]
MORE = [[70, 40], [300, 310], [-60, 40], [-40], [40, 20, 320, 50, 310, 300], [300, 70]]


@pytest.mark.parametrize(
    ("stated", "lists"),
    [
        ({}, LISTS),
        pytest.param({}, LISTS + MORE, marks=pytest.mark.long),
        pytest.param({"coupler": 400.0, "rocker": 100.0}, LISTS + MORE, marks=pytest.mark.long),
    ],
)
def test_springs_behind_a_gap_whatever_positions_are_asked(stated: Any, lists: list[list[float]]) -> None:
    """A crank that only swings, on both sides of where the linkage does not close: each side counts for itself."""
    f = ROCKER._replace(stated=stated)
    known: dict[tuple[float, float], list[float]] = {}
    for positions in lists:
        m = f.mechanism(positions)
        r = da.statics(m)
        assert da.compile(m)().effort("O2")[0] == pytest.approx(r.effort("O2"), rel=1e-9, nan_ok=True)
        sides = np.sign(np.sin(r.angle("rocker") - r.angle("coupler")))
        for q, effort, side in zip(positions, r.effort("O2"), sides, strict=True):
            if np.isfinite(effort):
                known.setdefault((q, side), []).append(effort)
    for efforts in known.values():
        assert efforts == pytest.approx([efforts[0]] * len(efforts), rel=1e-9)
    assert {q for (q, _), efforts in known.items() if len(efforts) > 1} >= {40, 320}
