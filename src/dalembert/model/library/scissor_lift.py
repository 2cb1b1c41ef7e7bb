"""Scissor lifts of any number of stages."""

from __future__ import annotations

from math import acos, atan2, degrees, sqrt
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library.tree_parts import (
    build_mechanism,
    force,
    pin,
    positive,
    slender,
    sliding,
    slot,
    turning,
)

if TYPE_CHECKING:
    from dalembert.model import Mechanism


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


def _check_scissor(stages: int, link: float, widths: tuple[float, float], drive: str) -> None:
    if isinstance(stages, bool) or not isinstance(stages, int) or stages < 1:
        raise ModelError(
            f"scissor: stages is {stages!r}; it must be an integer of at least 1",
            "for example scissor(3)",
        )
    positive("scissor", link=link, first_width=widths[0], last_width=widths[1])
    if max(widths) >= link:
        raise ModelError(
            f"scissor: with the roller {max(widths):g} m from the base pin, links of {link:g} m lie flat",
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
