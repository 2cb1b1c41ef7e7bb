"""Presses, lifts, robots and diggers: toggle press, five-bar, scissor lift, bucket."""

from __future__ import annotations

from math import acos, atan2, degrees, pi, sqrt
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library.compass import FULL_TURN, Points, angle, meet, reach, start_points, vector_at
from dalembert.model.library.tree_parts import (
    Point,
    build_mechanism,
    force,
    pin,
    plate,
    points_of,
    positive,
    slender,
    slider,
    sliding,
    slot,
    turning,
)

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def toggle_press(
    *,
    center: Point = (0.36, -0.18),
    crank: float = 0.048,
    rod: float = 0.3,
    upper: float = 0.24,
    lower: float = 0.24,
    pressing_force: float = 20000.0,
    ram_mass: float = 30.0,
    mass_per_length: float = 10.0,
    speed: float = 2 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""A toggle press: a crank pushes the knee K of two toggle links nearly straight, and the ram down hard.

    ::

            O4
              \ upper
               K ------- rod ------- A
              / lower           O2 _/ crank
            D [ram]

    `center` is the crank's centre O2 from O4, in metres, `crank`, `rod`, `upper` and `lower` between pins; the ram
    slides down the line below O4. `pressing_force` in N pushes the ram up. `ram_mass` in kg, the other links
    uniform and slender with `mass_per_length` in kg/m; gravity is on; `speed` in rad/s; `sweep` in radians. Raises
    ModelError where the toggle does not close or would pass its straight position.

    >>> from dalembert.model.library import toggle_press
    >>> toggle_press().joints["guide"].links
    ('ground', 'ram')
    """
    positive("toggle_press", crank=crank, rod=rod, upper=upper, lower=lower)
    positive("toggle_press", "kg", ram_mass=ram_mass, mass_per_length=mass_per_length)
    o2 = points_of("toggle_press", center=center)["center"]

    def place(turn: float) -> Points:
        a = o2 + vector_at(crank, turn)
        k = meet(a, ("rod", rod), 0, ("upper", upper))
        return {"O4": 0j, "A": a, "K": k, "D": reach(k, ("lower", lower), 0, -pi / 2)}

    at = start_points("toggle_press", place, sweep)
    return build_mechanism(
        "Toggle press",
        gravity="standard",
        links={
            "ground": {"points": {"O2": list(center), "O4": [0.0, 0.0]}},
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "rod": slender(mass_per_length, A=0.0, K=rod),
            "upper": slender(mass_per_length, O4=0.0, K=upper),
            "lower": slender(mass_per_length, K=0.0, D=lower),
            "ram": {"points": {"D": [0.0, 0.0]}, "mass": ram_mass},
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": pin("crank", "rod"),
            "K": pin("upper", "lower"),
            "K_rod": pin("upper", "rod", "K"),
            "O4": pin("ground", "upper"),
            "D": pin("lower", "ram"),
            "guide": slider("ground", "ram", ("O4", "D"), -90.0),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"pressing": force("ram", "D", (0.0, pressing_force))},
        assembly={
            "rod": angle(at, "A", "K"),
            "upper": angle(at, "O4", "K"),
            "lower": angle(at, "K", "D"),
            "ram": -90.0,
        },
    )


def five_bar(
    *,
    ground: float = 0.24,
    crank: float = 0.06,
    second_crank: float = 0.06,
    coupler: float = 0.24,
    second_coupler: float = 0.24,
    load: Point = (0.0, -50.0),
    mass_per_length: float = 2.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    second_sweep: tuple[float, float] = (pi / 2, 5 * pi / 2),
    positions: int = 72,
) -> Mechanism:
    r"""A five-bar linkage with two drives, the simplest parallel robot.

    ::

                  C
               /     \        couplers A C, B C
             A         B
        O2 /  - ground - \ O5   both cranks driven

    `ground` is O2 O5, `crank` O2 A, `second_crank` O5 B, `coupler` A C and `second_coupler` B C, in metres; `load`
    in N at C, in ground axes; links uniform and slender, `mass_per_length` in kg/m; `speed` of the first crank in
    rad/s, the second goes as much faster or slower as `second_sweep` is longer or shorter than `sweep` (radians). C
    is on the left of the way from A to B.

    >>> from dalembert.model.library import five_bar
    >>> sorted(five_bar().drives)
    ['O2', 'O5']
    """
    positive("five_bar", ground=ground, crank=crank, second_crank=second_crank)
    positive("five_bar", coupler=coupler, second_coupler=second_coupler)
    positive("five_bar", "kg/m", mass_per_length=mass_per_length)
    if sweep[0] == sweep[1]:
        raise ModelError("five_bar: the sweep of the crank begins where it ends", "give two different angles")
    ratio = (second_sweep[1] - second_sweep[0]) / (sweep[1] - sweep[0])

    def place(turn: float) -> Points:
        a = vector_at(crank, turn)
        b = ground + vector_at(second_crank, second_sweep[0] + ratio * (turn - sweep[0]))
        return {"A": a, "B": b, "C": meet(a, ("coupler", coupler), b, ("second coupler", second_coupler))}

    at = start_points("five_bar", place, sweep)
    return build_mechanism(
        "Five-bar linkage with two drives",
        links={
            "ground": {"points": {"O2": [0.0, 0.0], "O5": [ground, 0.0]}},
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "coupler": slender(mass_per_length, A=0.0, C=coupler),
            "second_coupler": slender(mass_per_length, B=0.0, C=second_coupler),
            "second_crank": slender(mass_per_length, O5=0.0, B=second_crank),
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": pin("crank", "coupler"),
            "C": pin("coupler", "second_coupler"),
            "B": pin("second_crank", "second_coupler"),
            "O5": pin("ground", "second_crank"),
        },
        drives={
            "O2": turning(sweep, positions, speed),
            "O5": turning(second_sweep, positions, ratio * speed),
        },
        loads={"load": force("second_coupler", "C", load)},
        assembly={"coupler": angle(at, "A", "C"), "second_coupler": angle(at, "B", "C")},
    )


def scissor(
    stages: int = 2,
    *,
    link: float = 1.2,
    widths: tuple[float, float] = (1.152, 0.72),
    drive: str = "slide",
    load: float = 2000.0,
    platform_mass: float = 60.0,
    mass_per_length: float = 5.0,
    speed: float = 0.0,
    positions: int = 31,
) -> Mechanism:
    r"""A scissor lift of any number of stages: pinned on the left, on rollers on the right, below and above.

    ::

            top_pin ====platform==== top_roller
               \  right_2    left_2 /
                  \     X     /          each stage k: left_k and right_k, named after
               /       X                  the side of their feet, pinned in the middle
              / left_1     right_1 \
        base_pin                base_roller -> slides on the ground

    `link` is the length of each link and `widths` the first and last distance of the roller from the base pin, in
    metres; `drive` is "slide" (a force on the roller) or "turn" (a couple at the base pin); `load` in N pushes down
    on the middle of the platform; masses in kg and kg/m, gravity on; `speed` in m/s of the roller or rad/s of the
    pin. Raises ModelError without stages or with a width that the links do not reach.

    >>> from dalembert.model.library import scissor
    >>> len(scissor(3).links)
    8
    """
    _check_scissor(stages, link, widths, drive)
    positive("scissor", "kg", platform_mass=platform_mass, mass_per_length=mass_per_length)
    rise = degrees(atan2(sqrt(link**2 - widths[0] ** 2), widths[0]))
    numbers = range(1, stages + 1)
    bar = slender(mass_per_length, foot=0.0, middle=link / 2, head=link)
    links: Tree = {"ground": {"points": {"B": [0.0, 0.0]}}}
    links |= {f"{side}_{k}": bar for k in numbers for side in ("left", "right")}
    links["platform"] = slender(platform_mass / link, P=0.0, M=link / 2, end=link)
    leaning = {"left": rise, "right": 180.0 - rise}
    turns = (acos(widths[0] / link), acos(widths[1] / link))
    return build_mechanism(
        f"Scissor lift of {stages} stage{'s' if stages > 1 else ''}",
        gravity="standard",
        links=links,
        joints=_scissor_joints(stages),
        drives={"base_roller": sliding(widths, positions, speed, "slide")}
        if drive == "slide"
        else {"base_pin": turning(turns, positions, speed)},
        loads={"load": force("platform", "M", (0.0, -load))},
        assembly={f"{side}_{k}": lean for k in numbers for side, lean in leaning.items()} | {"platform": 0.0},
    )


def bucket(
    *,
    base: Point = (-1.5, 0.36),
    rocker_pivot: Point = (-0.36, 0.06),
    rocker: float = 0.42,
    coupler: float = 0.42,
    ear: Point = (-0.3, 0.18),
    reach_to_tip: float = 0.9,
    strokes: tuple[float, float] = (0.9, 1.32),
    digging_force: float = 8000.0,
    bucket_mass: float = 80.0,
    mass_per_length: float = 20.0,
    speed: float = 0.0,
    positions: int = 43,
) -> Mechanism:
    r"""The bucket of an excavator with its hydraulic cylinder, rocker and coupler; the arm is the ground.

    ::

        Q ====cylinder===-----rod----- J
                                      / \ coupler
             arm (ground)    rocker  R   H
                                       P  bucket -> T (tip)

    P, the bucket's pivot, is the origin; `base` is the cylinder's pin Q and `rocker_pivot` R, from P in ground
    axes; `rocker` is R J, `coupler` J H; `ear` is H from P in the bucket's axes, whose x axis goes to the tip T at
    `reach_to_tip`; `strokes` are the first and last length Q J; in metres. `digging_force` in N acts at the tip,
    square to P T, against the closing bucket. Masses in kg and kg/m, gravity on; `speed` of the cylinder in m/s.

    >>> from dalembert.model.library import bucket
    >>> bucket().joints["J_coupler"].links
    ('rocker', 'coupler')
    """
    positive("bucket", rocker=rocker, coupler=coupler, reach_to_tip=reach_to_tip)
    positive("bucket", first_stroke=strokes[0], last_stroke=strokes[1])
    positive("bucket", "kg", bucket_mass=bucket_mass, mass_per_length=mass_per_length)
    local = points_of("bucket", base=base, rocker_pivot=rocker_pivot, ear=ear)
    q, r, size = local["base"], local["rocker_pivot"], abs(local["ear"])
    positive("bucket", distance_of_the_ear=size, height_of_the_ear=abs(local["ear"].imag))

    def place(stroke: float) -> Points:
        j = meet(q, ("cylinder", stroke), r, ("rocker", rocker))
        h = meet(j, ("coupler", coupler), 0, ("ear of the bucket", size))
        return {"P": 0j, "Q": q, "R": r, "J": j, "H": h, "T": reach_to_tip * h / local["ear"]}

    at = start_points("bucket", place, strokes, "cylinder", turn=False)
    solid = plate(2 * bucket_mass / (reach_to_tip * abs(ear[1])), P=(0.0, 0.0), T=(reach_to_tip, 0.0), H=ear)
    length = min(strokes)
    return build_mechanism(
        "Excavator bucket with hydraulic cylinder",
        gravity="standard",
        links={
            "ground": {"points": {"P": [0.0, 0.0], "Q": list(base), "R": list(rocker_pivot)}},
            "cylinder": slender(mass_per_length, Q=0.0, end=length),
            "rod": slender(mass_per_length, J=0.0, piston=-length),
            "rocker": slender(mass_per_length, R=0.0, J=rocker),
            "coupler": slender(mass_per_length, J=0.0, H=coupler),
            "bucket": solid,
        },
        joints={
            "Q": pin("ground", "cylinder"),
            "cylinder": slider("cylinder", "rod", ("Q", "J")),
            "J": pin("rod", "rocker"),
            "R": pin("ground", "rocker"),
            "J_coupler": pin("rocker", "coupler", "J"),
            "H": pin("coupler", "bucket"),
            "P": pin("ground", "bucket"),
        },
        drives={"cylinder": sliding(strokes, positions, speed)},
        loads={"digging": force("bucket", "T", (0.0, digging_force), axes="link")},
        assembly=dict.fromkeys(("cylinder", "rod"), angle(at, "Q", "J"))
        | {"rocker": angle(at, "R", "J"), "coupler": angle(at, "J", "H"), "bucket": angle(at, "P", "T")},
    )


def _check_scissor(stages: int, link: float, widths: tuple[float, float], drive: str) -> None:
    if isinstance(stages, bool) or not isinstance(stages, int) or stages < 1:
        raise ModelError(
            f"scissor: stages is {stages!r}, and must be a whole number of 1 or more",
            "for example scissor(3)",
        )
    positive("scissor", link=link, first_width=widths[0], last_width=widths[1])
    if max(widths) >= link:
        raise ModelError(
            f"scissor: the roller is to be {max(widths):g} m from the base pin, and links of {link:g} m lie flat there",
            f"give widths below {link:g} m, or longer links",
        )
    if drive not in ("slide", "turn"):
        raise ModelError(
            f"scissor: drive is {drive!r}", 'it is "slide" (the roller) or "turn" (the base pin)'
        )


def _scissor_joints(stages: int) -> Tree:
    joints: Tree = {"base_pin": pin("ground", "left_1") | {"at": ["B", "foot"]}}
    joints["base_roller"] = slot("ground", "right_1", ("B", "foot"))
    for k in range(1, stages + 1):
        joints[f"cross_{k}"] = pin(f"left_{k}", f"right_{k}", "middle")
        if k < stages:
            joints[f"left_{k}_{k + 1}"] = pin(f"right_{k}", f"left_{k + 1}") | {"at": ["head", "foot"]}
            joints[f"right_{k}_{k + 1}"] = pin(f"left_{k}", f"right_{k + 1}") | {"at": ["head", "foot"]}
    joints["top_pin"] = pin(f"right_{stages}", "platform") | {"at": ["head", "P"]}
    joints["top_roller"] = slot("platform", f"left_{stages}", ("P", "head"))
    return joints
