"""Torsion springs count whole turns by a rule that no list of positions changes, in every way of computing."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import pytest

import dalembert as da
from tests.random_space.drawing import Array
from tests.tiers import tiers

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
    *(pytest.param(name, seed, marks=pytest.mark.long) for name in FOUR_BARS for seed in range(2, 8)),
]


@pytest.mark.parametrize(("name", "seed"), CASES)
def test_springs_of_a_four_bar_whatever_positions_are_asked(name: str, seed: int) -> None:
    """Any positions over five turns, in any order: analyses, kernel and space have the moment of virtual work."""
    f, rng = FOUR_BARS[name], np.random.default_rng(seed)
    for count in (1, 6):
        places = rng.choice(CRANK, count, replace=False).tolist()
        m = f.mechanism(places)
        r = da.statics(m)
        expected = [f.effort(int(q)) for q in places]
        assert r.effort("O2") == pytest.approx(expected, rel=1e-9)
        assert da.compile(m)().effort("O2")[0] == pytest.approx(expected, rel=1e-9)
        assert da.statics(da.lifted(m)).effort("O2") == pytest.approx(expected, rel=1e-8)
        for joint in f.free:
            turn = r.freedom(joint, "turn")[0]
            assert np.degrees(turn) == pytest.approx([f.turns(joint)[int(q)][0] for q in places])


PRELOADED = FourBar(1, 4, 3, 4, {"coupler": 20, "rocker": 100}, {"O4": -120})
"""A crank-rocker whose rocker is preloaded by more than half a turn."""


def _issue(**more: Any) -> da.Mechanism:
    return PRELOADED.mechanism(90).with_values(more)


def test_a_preload_above_half_a_turn() -> None:
    m = _issue()
    for r in (da.statics(m), da.statics(da.lifted(m))):
        assert r.effort("O2") == pytest.approx([PRELOADED.effort(90)], rel=1e-10)
    assert da.compile(m)().effort("O2") == pytest.approx(PRELOADED.effort(90), rel=1e-10)


def test_the_answer_says_how_turns_were_counted() -> None:
    r = da.statics(_issue())
    turn = PRELOADED.turns("O4")[90][0]
    said = f"{turn:.6g} deg at O2 = 90 deg, counted to within half a turn of 100 deg of the assembly at O2 = 0 deg"
    either = f"; {turn - TURN:.6g} deg or {turn + TURN:.6g} deg could be meant too"
    other = f"{either}: the angles written in `assembly` choose"
    assert r.assumptions["turn of O4 for spring O4"] == said + other
    told = r.to_dict()
    assert told["counted_turns"]["spring O4"] == {
        "joint": "O4",
        "freedom": "turn",
        "within_half_a_turn_of": pytest.approx(np.radians(100)),
        "stated": True,
        "two_readings": True,
    }
    assert told["positions"][0]["spring_turns"]["spring O4"] == pytest.approx(np.radians(turn))
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


def _space(*angles: tuple[str, float], **joint: Any) -> Any:
    """The same crank-rocker in space, its springs' joints revolute, with poses of some links as they are written."""
    points = {
        "ground": {"O2": [0, 0, 0], "O4": [4, 0, 0]},
        "crank": {"O2": [0, 0, 0], "A": [1, 0, 0]},
        "coupler": {"A": [0, 0, 0], "B": [4, 0, 0]},
        "rocker": {"O4": [0, 0, 0], "B": [3, 0, 0]},
    }
    kinds = {"O2": "revolute", "A": "spherical", "B": "cylindrical", "O4": "revolute"}
    place = {"crank": [0, 0, 0], "coupler": [0, 1, 0], "rocker": [4, 0, 0]}
    return {
        "dalembert": 1,
        "space": "space",
        "links": {link: {"points": found} for link, found in points.items()},
        "joints": {
            name: {"type": kinds[name], "links": list(ends)}
            | ({"axis": [0, 0, 1]} if kinds[name] != "spherical" else {})
            for name, ends in ENDS.items()
        },
        "drives": {"O2": {"position": 90}},
        "loads": {"s": {"type": "torsion_spring", "joint": "O4", "stiffness": 10, "free_angle": -120}},
        "assembly": {
            link: {"position": place[link], "axis": [0, 0, 1 if angle > 0 else -1], "angle": abs(angle)}
            for link, angle in angles
        },
    }


@pytest.mark.parametrize(("written", "turns"), [(100, 0), (460, 1), (-260, -1)])
def test_poses_in_space_count_as_written(written: float, turns: int) -> None:
    """The effort at the rocker's angle, and as much more as the turns written more."""
    tree = _space(("crank", 90), ("coupler", 20), ("rocker", written))
    deflection = PRELOADED.turns("O4")[90][0] + 120
    expected = PRELOADED.effort(90) * (deflection + TURN * turns) / deflection
    for positions in ([90], [300, 90, -200], [90, 450]):
        tree["drives"]["O2"]["position"] = positions
        r = da.statics(da.mechanism(tree))
        assert r.effort("O2")[positions.index(90)] == pytest.approx(expected, rel=1e-8)


def test_a_screw_counts_the_turns_of_its_slide() -> None:
    tree: dict[str, Any] = {
        "dalembert": 1,
        "space": "space",
        "links": {"ground": {"points": {"O": [0, 0, 0]}}, "nut": {"points": {"O": [0, 0, 0]}}},
        "joints": {"O": {"type": "screw", "links": ["ground", "nut"], "axis": [0, 0, 1], "lead": 0.01}},
        "loads": {"s": {"type": "torsion_spring", "joint": "O", "stiffness": 3, "free_angle": 100}},
    }
    rate = 2 * np.pi / 0.01
    for slides in ([0.05], [-0.02, 0.05]):
        tree["drives"] = {"O": {"freedom": "slide", "position": slides}}
        r = da.statics(da.mechanism(tree))
        expected = 3 * (rate * np.array(slides) - np.radians(100)) * rate
        assert r.effort("O") == pytest.approx(expected, rel=1e-9)


def test_wheels_count_where_their_phase_is() -> None:
    """A wheel that stands at 460 deg where its pinion starts, at 90 deg; twice its size, so half as fast back."""
    tree = {
        "dalembert": 1,
        "links": {
            "ground": {"points": {"O": [0, 0], "C": [3, 0]}},
            "p": {"points": {"O": [0, 0]}},
            "w": {"points": {"C": [0, 0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "p"]},
            "C": {"type": "pin", "links": ["ground", "w"]},
            "g": {"type": "gear", "links": ["p", "w"], "at": ["O", "C"], "radii": [1, 2]},
        },
        "drives": {"O": {"position": [90, 180, 900]}},
        "loads": {"k": {"type": "torsion_spring", "joint": "C", "stiffness": 2}},
        "assembly": {"w": 460},
    }
    m = da.mechanism(tree)
    expected = -np.radians([460, 415, 55])
    for effort in (
        da.statics(m).effort("O"),
        da.compile(m)().effort("O")[0],
        da.statics(da.lifted(m)).effort("O"),
    ):
        assert effort == pytest.approx(expected, rel=1e-9)
    assert (
        "at the first position, where its wheels have their phase"
        in da.statics(m).assumptions["turn of C for k"]
    )


def test_a_turn_that_drives_settle_is_counted_by_them() -> None:
    """Two arms, each driven by more than two turns: the pin between them has the second drive's, and is not told."""
    tree = {
        "dalembert": 1,
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "a": {"points": {"O": [0, 0], "P": [1, 0]}},
            "b": {"points": {"P": [0, 0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "a"]},
            "P": {"type": "pin", "links": ["a", "b"]},
        },
        "drives": {"O": {"position": [970, 10]}, "P": {"position": [800, 0]}},
        "loads": {"s": {"type": "torsion_spring", "joint": "P", "stiffness": 2, "free_angle": 10}},
    }
    r = da.statics(da.mechanism(tree))
    assert r.effort("P") == pytest.approx(2 * np.radians([790, -10]))
    assert "counted_turns" not in r.to_dict()


@pytest.mark.parametrize("stated", tiers([{"crank": -60}], [{"crank": 60}, {"crank": 300}, {}]))
def test_turns_are_counted_at_the_end_where_the_way_is_barred(stated: dict[str, float]) -> None:
    """A slider-crank driven by its slide, which never gets to 0: the dead centre at half a turn is within it."""
    tree: dict[str, Any] = {
        "dalembert": 1,
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "crank": {"points": {"O": [0, 0], "A": [1, 0]}},
            "rod": {"points": {"A": [0, 0], "B": [3, 0]}},
            "block": {"points": {"B": [0, 0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "rod"]},
            "B": {"type": "pin", "links": ["rod", "block"]},
            "s": {"type": "slider", "links": ["ground", "block"], "at": ["O", "B"]},
        },
        "loads": {"k": {"type": "torsion_spring", "joint": "O", "stiffness": 2, "free_angle": 90}},
        "assembly": stated,
    }
    for slides in ([3.0], [2.0, 3.0, 2.2, 4.0]):
        tree["drives"] = {"s": {"position": slides}}
        r = da.statics(da.mechanism(tree))
        turn = np.degrees(r.freedom("O", "turn")[0])
        side = np.sign(np.sin(np.radians(stated.get("crank", 60))))
        closed = side * np.degrees(np.arccos((1 + np.square(slides) - 9) / (2 * np.array(slides))))
        moving = np.abs(np.abs(np.array(slides) - 3) - 1) > 1e-9
        assert turn[moving] == pytest.approx((closed + TURN * (stated.get("crank", 0) == 300))[moving])


def test_two_drives_count_straight_from_where_they_stand_at_0() -> None:
    """A five-bar whose cranks' ends can meet: around that place lists would count otherwise than straight on."""
    spots = {
        "ground": {"O": [0, 0], "Q": [1, 0]},
        "a": {"O": [0, 0], "A": [1, 0]},
        "b": {"A": [0, 0], "C": [2, 0]},
        "c": {"B": [0, 0], "C": [2, 0]},
        "d": {"Q": [0, 0], "B": [1, 0]},
    }
    ends = {"O": "ground a", "A": "a b", "C": "b c", "B": "d c", "Q": "ground d"}
    coil = {"type": "torsion_spring", "joint": "B", "stiffness": 2, "free_angle": 300}

    def statics(first: list[float], second: list[float]) -> Any:
        return da.statics(
            da.mechanism(
                {
                    "dalembert": 1,
                    "links": {link: {"points": found} for link, found in spots.items()},
                    "joints": {name: {"type": "pin", "links": text.split()} for name, text in ends.items()},
                    "drives": {"O": {"position": first}, "Q": {"position": second}},
                    "loads": {"s": coil},
                }
            )
        )

    first, second = [40, -20, 40, 400, 400], [-20, -20, 200, -300, 40]
    together = statics(first, second)
    side = np.sign(np.sin(together.angle("c") - together.angle("b")))
    compared = 0
    for k, (a, b) in enumerate(zip(first, second, strict=True)):
        alone = statics([a], [b])
        if np.sign(np.sin(alone.angle("c") - alone.angle("b")))[0] == side[k] and together.ok[k]:
            assert alone.effort_array[0] == pytest.approx(together.effort_array[k], rel=1e-9)
            compared += 1
    assert compared > 2


def test_only_free_turns_start_within_half_a_turn() -> None:
    """A driven turn is what is asked for, and a slide has no turns: here it is 10 m long."""
    tree = {
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "crank": {"points": {"O": [0, 0], "A": [10, 0]}},
            "guide": {"points": {"O": [0, 0]}},
            "block": {"points": {"A": [0, 0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "G": {"type": "pin", "links": ["ground", "guide"], "at": ["O", "O"]},
            "A": {"type": "pin", "links": ["crank", "block"]},
            "slide": {"type": "slider", "links": ["guide", "block"], "at": ["O", "A"]},
        },
        "drives": {"O": {"position": [400, 410]}},
        "assembly": {"guide": 40},
    }
    r = da.kinematics(da.mechanism(tree))
    assert r.freedom("O", "turn")[0] == pytest.approx(np.radians([400, 410]))
    assert r.freedom("slide", "slide")[0] == pytest.approx([10, 10])
    assert r.freedom("G", "turn")[0] == pytest.approx(np.radians([40, 50]))
