"""Stephenson's six-bar linkages: the two ternary links do not touch; driven by a crank that goes round."""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import TYPE_CHECKING

from dalembert.model.library.compass import FULL_TURN, GapError, Points, meet, start_points, vector_at
from dalembert.model.library.six_bars import (
    angles,
    check_six_bar,
    four_bar_points,
    four_pins,
    ground_link,
    on_link,
    output_pins,
)
from dalembert.model.library.tree_parts import (
    Point,
    build_mechanism,
    couple,
    force,
    pin,
    plate,
    points_of,
    positive,
    slender,
    turning,
)

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def stephenson_1(
    *,
    ground: float = 0.3,
    crank: float = 0.09,
    coupler: float = 0.3,
    rocker: float = 0.24,
    crank_point: Point = (0.06, 0.06),
    rocker_point: Point = (0.24, 0.12),
    upper_coupler: float = 0.21,
    upper_rocker: float = 0.21,
    load: Point = (0.0, -200.0),
    mass_per_length: float = 2.0,
    mass_per_area: float = 40.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Stephenson I: crank and rocker are the ternary links; a second dyad C E D joins them beside the coupler.

    ::

            C ----- E
           /|        \
          / A ---- B - D    crank O2 A C, rocker O4 B D
        O2 -------- O4

    `ground` is O2 O4, `crank` O2 A, `coupler` A B, `rocker` O4 B, `upper_coupler` C E and `upper_rocker` D E, in
    metres; `crank_point` is C from O2 with x towards A, `rocker_point` is D from O4 with x towards B; `load` in N
    at E on the upper rocker, in ground axes. Masses in kg/m (binary links) and kg/m2 (ternary plates); `speed` in
    rad/s; `sweep` in radians.

    >>> from dalembert.model.library import stephenson_1
    >>> stephenson_1().joints["C"].links
    ('crank', 'upper_coupler')
    """
    name = "stephenson_1"
    check_six_bar(
        name, mass_per_length, mass_per_area, ground=ground, crank=crank, coupler=coupler, rocker=rocker
    )
    positive(name, upper_coupler=upper_coupler, upper_rocker=upper_rocker)
    local = points_of(name, crank_point=crank_point, rocker_point=rocker_point)

    def place(turn: float) -> Points:
        at = four_bar_points(turn, ground, crank, coupler, rocker)
        c = on_link(0, at["A"], local["crank_point"])
        d = on_link(at["O4"], at["B"], local["rocker_point"])
        e = meet(c, ("upper coupler", upper_coupler), d, ("upper rocker", upper_rocker))
        return at | {"C": c, "D": d, "E": e}

    at = start_points(name, place, sweep)
    return build_mechanism(
        "Stephenson I six-bar",
        links={
            "ground": ground_link(O4=(ground, 0.0)),
            "crank": plate(mass_per_area, O2=(0.0, 0.0), A=(crank, 0.0), C=crank_point),
            "coupler": slender(mass_per_length, A=0.0, B=coupler),
            "rocker": plate(mass_per_area, O4=(0.0, 0.0), B=(rocker, 0.0), D=rocker_point),
            "upper_coupler": slender(mass_per_length, C=0.0, E=upper_coupler),
            "upper_rocker": slender(mass_per_length, D=0.0, E=upper_rocker),
        },
        joints=four_pins()
        | {
            "C": pin("crank", "upper_coupler"),
            "D": pin("rocker", "upper_rocker"),
            "E": pin("upper_coupler", "upper_rocker"),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"load": force("upper_rocker", "E", load)},
        assembly=angles(at, coupler="AB", rocker=("O4", "B"), upper_coupler="CE", upper_rocker="DE"),
    )


def stephenson_2(
    *,
    ground: float = 0.36,
    crank: float = 0.09,
    crank_point: Point = (0.0, 0.06),
    first_coupler: float = 0.3,
    second_coupler: float = 0.3,
    plate_length: float = 0.18,
    plate_point: Point = (0.09, 0.09),
    rocker: float = 0.3,
    torque: float = -10.0,
    mass_per_length: float = 2.0,
    mass_per_area: float = 40.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Stephenson II: two couplers carry a floating ternary plate, which drives the rocker; no four-bar on the ground.

    ::

             B ------- D - E      crank O2 A B, plate C D E
            /|         | /  \
           / A ------- C     \  rocker
          O2 ---- ground ---- O4

    `ground` is O2 O4, `crank` O2 A, `first_coupler` A C, `second_coupler` B D and `rocker` O4 E, in metres;
    `crank_point` is B from O2 with x towards A; `plate_length` is C D and `plate_point` E from C with x towards D;
    `torque` in N m on the rocker. Masses in kg/m (binary links) and kg/m2 (ternary plates); `speed` in rad/s;
    `sweep` in radians.

    >>> from dalembert.model.library import stephenson_2
    >>> stephenson_2().joints["E"].links
    ('plate', 'rocker')
    """
    name = "stephenson_2"
    check_six_bar(name, mass_per_length, mass_per_area, ground=ground, crank=crank, rocker=rocker)
    positive(name, first_coupler=first_coupler, second_coupler=second_coupler, plate_length=plate_length)
    local = points_of(name, crank_point=crank_point, plate_point=plate_point)
    ends = (("first coupler", first_coupler), ("second coupler", second_coupler), ("plate", plate_length))

    def dyad(turn: float, lean: float) -> Points:
        a, b = vector_at(crank, turn), vector_at(1.0, turn) * local["crank_point"]
        c = a + vector_at(first_coupler, lean)
        d = meet(c, ends[2], b, ends[1])
        return {
            "A": a,
            "B": b,
            "C": c,
            "D": d,
            "E": on_link(c, d, local["plate_point"]),
            "O4": complex(ground),
        }

    at = start_points(name, _follow(dyad, ("rocker", rocker)), sweep)
    return build_mechanism(
        "Stephenson II six-bar",
        links={
            "ground": ground_link(O4=(ground, 0.0)),
            "crank": plate(mass_per_area, O2=(0.0, 0.0), A=(crank, 0.0), B=crank_point),
            "first_coupler": slender(mass_per_length, A=0.0, C=first_coupler),
            "second_coupler": slender(mass_per_length, B=0.0, D=second_coupler),
            "plate": plate(mass_per_area, C=(0.0, 0.0), D=(plate_length, 0.0), E=plate_point),
            "rocker": slender(mass_per_length, O4=0.0, E=rocker),
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": pin("crank", "first_coupler"),
            "B": pin("crank", "second_coupler"),
            "C": pin("first_coupler", "plate"),
            "D": pin("second_coupler", "plate"),
            "E": pin("plate", "rocker"),
            "O4": pin("ground", "rocker"),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"torque": couple("rocker", torque)},
        assembly=angles(at, first_coupler="AC", second_coupler="BD", plate="CD", rocker=("O4", "E")),
    )


def stephenson_3(
    *,
    ground: float = 0.3,
    crank: float = 0.09,
    coupler: float = 0.3,
    rocker: float = 0.24,
    coupler_point: Point = (0.15, 0.15),
    second_ground: Point = (0.48, 0.06),
    second_coupler: float = 0.42,
    output: float = 0.3,
    torque: float = -10.0,
    mass_per_length: float = 2.0,
    mass_per_area: float = 40.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Stephenson III: a point of a four-bar's coupler drives an output rocker through a second coupler.

    ::

             C ----------- D
            /  \          /
           A -- B        /      coupler A B C, output O6 D
          /      \      O6
        O2 ------ O4

    `ground` is O2 O4, `crank` O2 A, `coupler` A B, `rocker` O4 B, `second_coupler` C D and `output` O6 D, in
    metres; `coupler_point` is C from A with x towards B; `second_ground` is O6 from O2; `torque` in N m on the
    output rocker. Masses in kg/m (binary links) and kg/m2 (ternary plate); `speed` in rad/s; `sweep` in radians.
    The usual dwell mechanisms are of this kind.

    >>> from dalembert.model.library import stephenson_3
    >>> stephenson_3(output=0.27).joints["C"].links
    ('coupler', 'second_coupler')
    """
    name = "stephenson_3"
    check_six_bar(
        name, mass_per_length, mass_per_area, ground=ground, crank=crank, coupler=coupler, rocker=rocker
    )
    positive(name, second_coupler=second_coupler, output=output)
    local = points_of(name, coupler_point=coupler_point, second_ground=second_ground)

    def place(turn: float) -> Points:
        at = four_bar_points(turn, ground, crank, coupler, rocker)
        c = on_link(at["A"], at["B"], local["coupler_point"])
        d = meet(c, ("second coupler", second_coupler), local["second_ground"], ("output", output))
        return at | {"C": c, "D": d, "O6": local["second_ground"]}

    at = start_points(name, place, sweep)
    return build_mechanism(
        "Stephenson III six-bar",
        links={
            "ground": ground_link(O4=(ground, 0.0), O6=second_ground),
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "coupler": plate(mass_per_area, A=(0.0, 0.0), B=(coupler, 0.0), C=coupler_point),
            "rocker": slender(mass_per_length, O4=0.0, B=rocker),
            "second_coupler": slender(mass_per_length, C=0.0, D=second_coupler),
            "output": slender(mass_per_length, O6=0.0, D=output),
        },
        joints=four_pins() | output_pins("coupler"),
        drives={"O2": turning(sweep, positions, speed)},
        loads={"torque": couple("output", torque)},
        assembly=angles(at, coupler="AB", rocker=("O4", "B"), second_coupler="CD", output=("O6", "D")),
    )


def _follow(dyad: Callable[[float, float], Points], rocker: tuple[str, float]) -> Callable[[float], Points]:
    """Place the plate of Stephenson II by Newton on the lean of the first coupler, from its last value."""
    last: list[float] = []

    def error(turn: float, lean: float) -> float:
        at = dyad(turn, lean)
        return abs(at["E"] - at["O4"]) - rocker[1]

    def place(turn: float) -> Points:
        lean = last[0] if last else _first_lean(lambda lean: error(turn, lean), rocker)
        for _ in range(20):
            miss = error(turn, lean)
            slope = (error(turn, lean + 1e-7) - miss) / 1e-7
            if abs(miss) < 1e-12 * rocker[1] or slope == 0:
                break
            lean -= max(-0.2, min(0.2, miss / slope))
        if abs(miss) > 1e-9 * rocker[1]:
            raise _no_rocker(rocker, abs(miss))
        last[:] = [lean]
        return dyad(turn, lean)

    return place


def _first_lean(error: Callable[[float], float], rocker: tuple[str, float]) -> float:
    """The first lean from 0 to a full turn near which the error changes its sign upwards."""
    before, smallest = float("nan"), float("inf")
    for k in range(721):
        lean = k * pi / 360
        try:
            here = error(lean)
        except GapError:
            here = float("nan")
        if before <= 0 < here:
            return lean
        before, smallest = here, min(smallest, abs(here)) if here == here else smallest
    raise _no_rocker(rocker, smallest)


def _no_rocker(rocker: tuple[str, float], miss: float) -> GapError:
    what = f"rocker {rocker[1]:g} m misses the point E of the plate by {miss:.3g} m"
    return GapError(miss, what, "change the rocker or the ground")
