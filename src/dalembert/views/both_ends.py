"""Drawings where friction has two answers, one under the other: both impending motions at rest, and the states just
before and just after contacts reverse."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.joint_friction import (
    NO_END,
    joints_at_limit,
    reversing_joints,
    unknown_names,
)
from dalembert.analysis.result.number_kinds import unknown_kinds
from dalembert.views.notation import Shown
from dalembert.views.paper.lettering import BOLD, break_lines
from dalembert.views.paper.scene import Scene, Text, stack_scenes

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

WIDTH = 180.0
"""Width available for a heading, mm."""


def end_words(r: Result, name: str, end: Result, which: str, k: int, shown: Shown) -> str:
    """Sentence such as 'Low end of O, −7304 N·m: friction is at its limit in O, A', or that no value exists."""
    value = float((end.effort(name) if name in r.drives else end.unknown_load(name))[k])
    if not math.isfinite(value):
        return f"{which} end of {name}: {NO_END}"
    figure = shown.text(unknown_kinds(r)[name], value)
    joints = ", ".join(joints_at_limit(end, k))
    return f"{which} end of {name}, {figure}: friction is at its limit in {joints or 'no joint'}"


def ends(r: Result, k: int, shown: Shown) -> list[tuple[str, Result, bool]]:
    """Both ends of every unknown at a position: a sentence, the result for it, and whether it has a value."""
    out = []
    for name, pair in zip(unknown_names(r), r.ends, strict=True):
        for which, end in zip(("Low", "High"), pair, strict=True):
            words = end_words(r, name, end, which, k, shown)
            out.append((words, end, "no value" not in words))
    return out


def sides(r: Result, k: int, shown: Shown) -> list[tuple[str, Result, bool]]:
    """Both sides of a reversal: a sentence, the result for it, and whether its forces are known."""
    joints, out = " and ".join(reversing_joints(r, k)), []
    for word, side in zip(("before", "after"), r.sides, strict=True):
        parts = []
        for name in unknown_names(r):
            value = float((side.effort(name) if name in r.drives else side.unknown_load(name))[k])
            figure = shown.text(unknown_kinds(r)[name], value) if math.isfinite(value) else "not known"
            parts.append(f"{name} {figure}")
        known = bool(np.isfinite(side.least_norm(r.joints[0])[k]).all())
        what = "jump of the acceleration in" if r.status[k] == "jump" else "reversal of"
        out.append((", ".join([f"Just {word} the {what} {joints}", *parts]), side, known))
    return out


def open_at(r: Result, k: int) -> bool:
    """True if friction leaves the forces undetermined at a position and both ends are available."""
    return r.status[k] == "at_rest" and bool(r.ends)


def at_both_ends(r: Result, k: int, shown: Shown, drawn: Callable[[Result], Scene], title: str) -> Scene:
    """Drawing of the result by ``drawn``; of both ends where friction leaves the forces undetermined, or of both sides
    of a reversal."""
    if not open_at(r, k) and not r.reverses[k]:
        return drawn(r)
    scenes = []
    for words, end, known in ends(r, k, shown) if open_at(r, k) else sides(r, k, shown):
        lines = enumerate(break_lines(words, 3.6 * BOLD, WIDTH))
        scenes.append(Scene(tuple(Text((0.0, -4.8 * n), s, 3.6, "title", "start") for n, s in lines), words))
        scenes += [drawn(end)] if known else []
    return stack_scenes(scenes, title=title, width=0.0)
