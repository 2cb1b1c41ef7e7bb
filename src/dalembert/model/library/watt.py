"""Watt's six-bar linkages: the two ternary links touch; driven by a crank that goes round."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from dalembert.model.library.compass import FULL_TURN, Points, meet, start_points
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


def watt_1(
    *,
    ground: float = 0.3,
    crank: float = 0.09,
    coupler: float = 0.3,
    rocker: float = 0.24,
    coupler_point: Point = (0.15, 0.12),
    rocker_point: Point = (0.3, -0.06),
    upper_coupler: float = 0.18,
    upper_rocker: float = 0.18,
    load: Point = (0.0, -200.0),
    mass_per_length: float = 2.0,
    mass_per_area: float = 40.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Watt I: on a four-bar's coupler and rocker stands a second loop that touches the ground nowhere.

    ::

             C ---- E      upper coupler C E, upper rocker D E
            /  \     \
           A -- B --- D    coupler A B C, rocker O4 B D
          /      \
        O2 ------ O4

    `ground` is O2 O4, `crank` O2 A, `coupler` A B, `rocker` O4 B, `upper_coupler` C E and `upper_rocker` D E, in
    metres; `coupler_point` is C from A with x towards B, `rocker_point` is D from O4 with x towards B; `load` in N
    at E on the upper rocker, in ground axes. Masses in kg/m (binary links) and kg/m2 (ternary plates); `speed` in
    rad/s; `sweep` in radians.

    >>> from dalembert.model.library import watt_1
    >>> len(watt_1().joints)
    7
    """
    name = "watt_1"
    check_six_bar(
        name, mass_per_length, mass_per_area, ground=ground, crank=crank, coupler=coupler, rocker=rocker
    )
    positive(name, upper_coupler=upper_coupler, upper_rocker=upper_rocker)
    local = points_of(name, coupler_point=coupler_point, rocker_point=rocker_point)

    def place(turn: float) -> Points:
        at = four_bar_points(turn, ground, crank, coupler, rocker)
        c = on_link(at["A"], at["B"], local["coupler_point"])
        d = on_link(at["O4"], at["B"], local["rocker_point"])
        e = meet(d, ("upper rocker", upper_rocker), c, ("upper coupler", upper_coupler))
        return at | {"C": c, "D": d, "E": e}

    at = start_points(name, place, sweep)
    return build_mechanism(
        "Watt I six-bar",
        links={
            "ground": ground_link(O4=(ground, 0.0)),
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "coupler": plate(mass_per_area, A=(0.0, 0.0), B=(coupler, 0.0), C=coupler_point),
            "rocker": plate(mass_per_area, O4=(0.0, 0.0), B=(rocker, 0.0), D=rocker_point),
            "upper_coupler": slender(mass_per_length, C=0.0, E=upper_coupler),
            "upper_rocker": slender(mass_per_length, D=0.0, E=upper_rocker),
        },
        joints=four_pins()
        | {
            "C": pin("coupler", "upper_coupler"),
            "D": pin("rocker", "upper_rocker"),
            "E": pin("upper_coupler", "upper_rocker"),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"load": force("upper_rocker", "E", load)},
        assembly=angles(at, coupler="AB", rocker=("O4", "B"), upper_coupler="CE", upper_rocker="DE"),
    )


def watt_2(
    *,
    ground: float = 0.3,
    crank: float = 0.09,
    coupler: float = 0.3,
    rocker: float = 0.24,
    rocker_point: Point = (0.18, -0.12),
    second_ground: Point = (0.66, 0.0),
    second_coupler: float = 0.3,
    output: float = 0.24,
    torque: float = -20.0,
    mass_per_length: float = 2.0,
    mass_per_area: float = 40.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Watt II: two four-bars in series, the rocker of the first is the crank of the second.

    ::

           A ----- B                D
          /         \__ C ------- /
        O2 -------- O4 ---------- O6      rocker O4 B C, output O6 D

    `ground` is O2 O4, `crank` O2 A, `coupler` A B, `rocker` O4 B, `second_coupler` C D and `output` O6 D, in
    metres; `rocker_point` is C from O4 with x towards B; `second_ground` is O6 from O2; `torque` in N m on the
    output rocker. Masses in kg/m (binary links) and kg/m2 (ternary plate); `speed` in rad/s; `sweep` in radians.

    >>> from dalembert.model.library import watt_2
    >>> watt_2().loads["torque"].on
    'output'
    """
    name = "watt_2"
    check_six_bar(
        name, mass_per_length, mass_per_area, ground=ground, crank=crank, coupler=coupler, rocker=rocker
    )
    positive(name, second_coupler=second_coupler, output=output)
    local = points_of(name, rocker_point=rocker_point, second_ground=second_ground)

    def place(turn: float) -> Points:
        at = four_bar_points(turn, ground, crank, coupler, rocker)
        c = on_link(at["O4"], at["B"], local["rocker_point"])
        d = meet(c, ("second coupler", second_coupler), local["second_ground"], ("output", output))
        return at | {"C": c, "D": d, "O6": local["second_ground"]}

    at = start_points(name, place, sweep)
    return build_mechanism(
        "Watt II six-bar",
        links={
            "ground": ground_link(O4=(ground, 0.0), O6=second_ground),
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "coupler": slender(mass_per_length, A=0.0, B=coupler),
            "rocker": plate(mass_per_area, O4=(0.0, 0.0), B=(rocker, 0.0), C=rocker_point),
            "second_coupler": slender(mass_per_length, C=0.0, D=second_coupler),
            "output": slender(mass_per_length, O6=0.0, D=output),
        },
        joints=four_pins() | output_pins("rocker"),
        drives={"O2": turning(sweep, positions, speed)},
        loads={"torque": couple("output", torque)},
        assembly=angles(at, coupler="AB", rocker=("O4", "B"), second_coupler="CD", output=("O6", "D")),
    )
