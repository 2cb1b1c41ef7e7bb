"""Branches of the groups at the first position: chosen by the given angles, as on the careful path."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.kept_program import KeptProgram
from dalembert.analysis.positions import mode_sentence, on_stated_sides
from dalembert.arrays import Array
from dalembert.core.position.assembly_modes import NEAR
from dalembert.core.position.first_pose_plane import Guess

AGREES = 1e-6
"""Difference of rotations above which a pose is another one."""


class First(NamedTuple):
    """Branches of the groups, the links' angles (L,), and the sentence on the assembly mode."""

    branches: tuple[float, ...]
    turn: Array
    mode: str | None


FEW = 6
"""Number of branch sets up to which they are tried one by one, on single numbers; more of them side by side."""

REMEMBERED = 32
"""First poses of a structure that are remembered."""


def first_branch(k: KeptProgram, c: Compiled, inputs: list[object]) -> First | None:
    """The branches that the careful path takes at the first position; None where a check is in doubt."""
    key = _key(k, c, inputs)
    first: First | None = k.known.get(key)
    if first is None and key not in k.known:
        first = _by_known_angles(k, c, inputs) or _by_search(k, c, inputs)
        remember(k, c, inputs, first)
    return first


def remember(k: KeptProgram, c: Compiled, inputs: list[object], first: First | None) -> None:
    """Keeps the result for the next analysis that starts from the same pose."""
    if len(k.known) >= REMEMBERED:
        k.known.clear()
    k.known[_key(k, c, inputs)] = first


def _key(k: KeptProgram, c: Compiled, inputs: list[object]) -> tuple[object, ...]:
    """All that decides a first pose, and names it."""
    guess = c.guess
    assert isinstance(guess, Guess)
    return c.links, tuple(inputs[place] for place in k.decisive), guess.turn.tobytes(), guess.point.tobytes()


def _tried(k: KeptProgram, inputs: list[object], branches: Array) -> tuple[Array, Array]:
    """Cosines and sines (2, L, W) of the first position for branches (G, W), and closure (M, W); NaN where it does not
    close."""
    rotation, closure = k.nodes["rotation"], k.nodes["closure"]
    out = np.full((rotation.size + closure.size, branches.shape[1]), np.nan)
    if branches.shape[1] > FEW:
        with np.errstate(all="ignore"):
            k.try_branches([*inputs, *branches], out)
    else:
        for column, branch in zip(out.T, branches.T.tolist(), strict=True):
            with suppress(ArithmeticError, ValueError):
                k.try_branches([*inputs, *branch], column, one=True)
    return out[: rotation.size].reshape(*rotation.shape, -1), out[rotation.size :]


def _by_known_angles(k: KeptProgram, c: Compiled, inputs: list[object]) -> First | None:
    """The branches taken when it was traced, where they put all given links near their angles and no others do.

    Every other set of branches differs first in some group, the groups before it having the same pose.
    """
    guess = c.guess
    assert isinstance(guess, Guess)
    wanted = guess.turn[:-1].tolist()
    stated = [math.isfinite(x) for x in wanted]
    loose = (k.counted & ~k.fixed).tolist()
    if not any(stated) or any(x and not y for x, y in zip(loose, stated, strict=True)):
        return None
    if np.isfinite(guess.point[:-1]).any():
        return None
    count = len(k.branches)
    rotation, closure = _tried(
        k, inputs, np.array(k.branches)[:, None] * (1.0 - 2.0 * np.eye(count, count + 1, 1))
    )
    if not (closure[:, 0] >= 0).all():
        return None
    cosine, sine = rotation.tolist()
    last, offsets = k.last.tolist(), [list[float]() for _ in range(count)]
    turn, missed = [], 0.0
    for link, known in enumerate(stated):
        angle = math.atan2(sine[link][0], cosine[link][0])
        if known:
            off = _wrapped(angle - wanted[link])
            missed += off * off
            group = last[link]
            if group >= 0:
                other = math.atan2(sine[link][group + 1], cosine[link][group + 1])
                offsets[group].append(abs(_wrapped(other - wanted[link])))
        turn.append(wanted[link] + off if known and k.counted[link] else angle)
    if not missed < NEAR**2 or any(
        not (all(map(math.isfinite, w)) and max(w, default=0.0) > NEAR) for w in offsets
    ):
        return None
    return First(k.branches, np.array(turn), None)


def _wrapped(angle: float) -> float:
    """An angle reduced to (-pi, pi]; NaN of none."""
    return angle - 2 * math.pi * math.ceil(angle / (2 * math.pi) - 0.5) if math.isfinite(angle) else angle


def _by_search(k: KeptProgram, c: Compiled, inputs: list[object]) -> First | None:
    """Branches of the pose from a search for the first pose."""
    modes = c.first_modes
    if modes is None or not on_stated_sides(c, c.first_target, modes):
        return None
    pose = modes.pose.at(0)
    stands = pose.rotation[:-1].T[..., None]
    branches = np.array(k.branches)
    for group in range(len(branches)):
        both = np.stack([branches, branches], axis=1)
        both[group, 1] *= -1
        rotation, _ = _tried(k, inputs, both)
        off = np.abs(rotation - stands)[:, k.last == group].max(axis=(0, 1), initial=0.0)
        if off[1] < off[0]:
            branches = both[:, 1]
    rotation, closure = _tried(k, inputs, branches[:, None])
    if not ((closure >= 0).all() and (np.abs(rotation - stands) < AGREES).all()):
        return None
    return First(tuple(branches.tolist()), pose.turn[:-1], mode_sentence(c, modes))
