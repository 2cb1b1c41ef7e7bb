"""Result of a kernel: the same quantities as a ``Result``, with a leading axis design."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dalembert import errors
from dalembert.algebra import plane, space
from dalembert.analysis.result.named_quantities import component
from dalembert.answer.answer import Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.answer.named_answer import NamedAnswer
from dalembert.arrays import Array, Flags, Tree
from dalembert.errors import STATUSES, ModelError
from dalembert.printing import Part

if TYPE_CHECKING:
    from dalembert.model import Mechanism

CODES = (
    "ok",
    "not_assembled",
    "undecided",
    "at_rest",
    "singular",
    "no_balance",
    "failed",
    "jammed",
    "redundant",
    "self_locking",
    "undefined_load",
    "overflow",
    "no_derivative",
    "reversal",
    "outside_table",
    "contact_lost",
    "slips",
    "slack",
    "freewheels",
    "out_of_stroke",
    "jump",
)
"""Statuses by the status codes of the kernel; `undecided` goes to the general executor and is not returned."""

NUMBERED = tuple(CODES.index(status) for status in (*errors.NUMBERED, "no_derivative"))
"""Marks of positions that have numbers."""

SOLVED = tuple(CODES.index(status) for status in errors.SOLVED)
"""Marks of positions that are solved."""


BLOCK = 1 << 26
"""Bytes of the results of a block of designs."""


def among(codes: NDArray[np.uint8], some: Sequence[int]) -> Flags:
    """True where a code is one of some, for many codes twenty times as fast as np.isin."""
    return np.asarray(np.logical_or.reduce([codes == mark for mark in some]))


def first_mark(codes: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Status code of several positions (..., position): the first in the list above, of those without numbers if one
    occurs; 0 where all are ok."""
    later = 100 * among(codes, NUMBERED) + 100 * (codes == 0)
    return np.asarray((codes + later).min(axis=-1) % 100, np.uint8)


def not_finite(code: NDArray[np.uint8], arrays: dict[str, Array]) -> Flags:
    """True where, in the axes of the codes, some value of some output is infinite or not a number."""
    out = np.zeros(code.shape, bool)
    for array in arrays.values():
        out |= ~np.isfinite(array).all(axis=tuple(range(code.ndim, array.ndim)))
    return out


def mark_overflow(code: NDArray[np.uint8], arrays: dict[str, Array], rates: dict[str, Array]) -> None:
    """Give a status to what should have numbers and has none, and to numbers without a derivative."""
    code[not_finite(code, arrays) & among(code, NUMBERED)] = CODES.index("overflow")
    code[not_finite(code, rates) & among(code, SOLVED)] = CODES.index("no_derivative")
    for rate in rates.values():
        rate[np.isinf(rate)] = np.nan


@dataclass(frozen=True, repr=False, eq=False)
class BatchResult(NamedAnswer, Labelled):
    """Answer for many designs: arrays (design, position), or (design,) where reduced over the positions.

    SI and radians, vectors in ground axes with their components last. NaN where unsolved; ``status`` gives the reason.
    Where contacts reverse the numbers are those just before, and ``after`` is the complete answer with those just
    after; None where no contact reverses, and where reduced: reductions are over both.

    >>> import dalembert as da
    >>> k = da.compile(da.four_bar(), ["links.coupler.mass"], ["effort.O2"])
    >>> answer = k([[1.0], [2.0]])
    >>> answer.effort("O2").shape, bool(answer.ok.all())
    ((2, 72), True)
    """

    kernel: Any = field(compare=False)
    values: Array  # (design, number)
    positions: Array  # (position, drive)
    code: NDArray[np.uint8]
    arrays: dict[str, Array]
    gradients: dict[str, Array]
    redone: int = 0
    after: BatchResult | None = None

    ROW = "design"
    ROWS = "rows"

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """One row per position of each design, or per design where reduced: numbers, status, outputs."""
        from dalembert.analysis.batch.batch_columns import batch_columns

        return batch_columns(self)

    def labelled(self, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
        """Outputs over designs, positions and components, and coordinates."""
        from dalembert.analysis.batch.batch_columns import batch_arrays

        return batch_arrays(self, to)

    def record(self, to: Scale) -> Tree:
        """Reduction over the positions, if any."""
        return {"reduce": self.kernel.reduce}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Least and greatest value of each number; designs with a problem."""
        from dalembert.analysis.batch.batch_columns import batch_parts

        return batch_parts(self, units)

    def keys(self) -> list[str]:
        """Names of the outputs."""
        return list(self.arrays)

    def __getitem__(self, name: str) -> Array:
        """An output by its name, or a component of a vector that is not reduced."""
        vector, _, part = name.rpartition(".")
        if name in self.arrays or vector not in self.arrays or self.kernel.reduce is not None:
            return self.value(name)
        return component(self.arrays[vector], part, name, self.code.ndim)

    def both_sides(self, name: str) -> list[Array]:
        """An output, and where contacts reverse also its values just after."""
        return [one_number(name, a, self.kernel.reduce is not None) for a in super().both_sides(name)]

    @property
    def codes(self) -> Array:
        """Statuses (design,) or (design, position)."""
        return self.status

    @property
    def mechanism(self) -> Mechanism:
        """The description that was compiled."""
        return self.kernel.mechanism  # type: ignore[no-any-return]

    def compared(self) -> Tree:
        """Data that equal answers share: the recipe of the kernel, and all numbers."""
        return super().compared() | {"kernel": self.kernel.__reduce__()[1]}

    @property
    def status(self) -> Array:
        """Code of each design and position; of each design where reduced."""
        return np.array(CODES, object)[self.code]

    @property
    def ok(self) -> Flags:
        """True where a design is solved, at a reversal on both sides; self-locking positions, and those without a
        derivative, have numbers too."""
        return among(self.code, SOLVED)

    def problems(self) -> list[tuple[int, str, str]]:
        """Designs with something that is not ok: number from 0, status and its sentence."""
        worst = self.code if self.code.ndim < 2 else first_mark(self.code)
        bad = np.flatnonzero(~among(worst, SOLVED))
        return [(int(d), CODES[worst[d]], _sentence(CODES[worst[d]])) for d in bad]

    def value(self, output: str) -> Array:
        """An output by the name it was compiled with."""
        if output not in self.arrays:
            raise ModelError(
                f"{output!r} was not compiled", "compile with outputs=[..., " + repr(output) + "]"
            )
        return self.arrays[output]

    def gradient(self, output: str) -> Array:
        """Derivatives of an output with respect to the numbers, which are a last axis in the order of k.numbers."""
        self.value(output)
        if output not in self.gradients:
            raise ModelError("no derivatives were compiled", "compile with derivatives=True")
        return self.gradients[output]

    def effort(self, drive: str) -> Array:
        """Effort of a drive, N m or N."""
        return self.value(f"effort.{drive}")

    def unknown_load(self, name: str) -> Array:
        """Value of an unknown load."""
        return self.value(f"load.{name}")

    def reaction(self, joint: str, on: str | None = None, axes: str = "ground") -> Array:
        """Force of a joint on one of its links, default its j; reduced component by component."""
        if axes not in ("ground", "link"):
            raise ModelError(f"unknown axes {axes!r}", "use ground or link")
        force = self._sign(joint, on) * self.value(f"reaction.{joint}")
        if axes != "link":
            return force
        link = on or self.kernel.mechanism.joints[joint].links[1]
        if self.kernel.reduce is not None:
            raise ModelError("a reduced reaction has ground axes only", 'leave axes="link" out')
        if link == "ground":
            return force
        if self.kernel.mechanism.dimension == 3:
            return space.unrotate(self.value(f"rotation.{link}"), force)
        return plane.unrotate(plane.rotation(self.angle(link)), force)

    def magnitude(self, joint: str) -> Array:
        """Size of a joint's force."""
        return self.value(f"reaction.{joint}.magnitude")

    def reaction_moment(self, joint: str, on: str | None = None) -> Array:
        """Moment of a joint about j's point."""
        return self._sign(joint, on) * self.value(f"reaction_moment.{joint}")

    def _sign(self, joint: str, on: str | None) -> float:
        joints = self.kernel.mechanism.joints
        if joint not in joints:
            raise ModelError(f"unknown joint {joint!r}", f"the joints are {', '.join(joints)}")
        i, j = joints[joint].links
        if on not in (None, i, j):
            raise ModelError(
                f"joint {joint!r} does not act on {on!r}", f"it joins {i} and {j}", ("joints", joint)
            )
        if on == i and self.kernel.reduce not in (None, "mean"):
            if self.kernel.reduce == "envelope":
                raise ModelError(f"the envelope is that of the force on {j!r}", f"ask on={j!r}")
            return 1.0
        return -1.0 if on == i else 1.0

    def angle(self, link: str) -> Array:
        """Angle of a link, full turns counted."""
        return self.value(f"angle.{link}")

    def rotation(self, link: str) -> Array:
        """Matrix of a link's rotation, row by row in a last axis: from its axes into ground's."""
        return self.value(f"rotation.{link}")

    def speed(self, link: str) -> Array:
        """Angular velocity of a link."""
        return self.value(f"angle.{link}.speed")

    def acceleration(self, link: str) -> Array:
        """Angular acceleration of a link."""
        return self.value(f"angle.{link}.acceleration")

    def position(self, link: str) -> Array:
        """Origin of a link's axes."""
        return self.value(f"point.{link}.origin")

    def velocity(self, link: str) -> Array:
        """Velocity of the origin of a link's axes."""
        return self.value(f"point.{link}.origin.velocity")

    def center(self, link: str) -> Array:
        """Mass centre of a link."""
        return self.value(f"point.{link}.center")

    def center_velocity(self, link: str) -> Array:
        """Velocity of a link's mass centre."""
        return self.value(f"point.{link}.center.velocity")

    def center_acceleration(self, link: str) -> Array:
        """Acceleration of a link's mass centre."""
        return self.value(f"point.{link}.center.acceleration")

    def point(self, link: str, name: str) -> Array:
        """A named point of a link."""
        return self.value(f"point.{link}.{name}")

    def point_velocity(self, link: str, name: str) -> Array:
        """Velocity of a named point of a link."""
        return self.value(f"point.{link}.{name}.velocity")

    def point_acceleration(self, link: str, name: str) -> Array:
        """Acceleration of a named point of a link."""
        return self.value(f"point.{link}.{name}.acceleration")


def one_number(name: str, values: Array, reduced: bool) -> Array:
    """Values of an output; a reduced one that has several numbers in each design is refused."""
    if reduced and values.ndim > 1:
        raise ModelError(
            f"{name} has {values[0].size} numbers a design",
            'ask for one: reduce="peak" of a scalar, as reaction.A.magnitude',
        )
    return values


def _sentence(code: str) -> str:
    if code in STATUSES:
        return STATUSES[code].sentence
    if code == "no_derivative":
        return "The values are correct, but some derivative is undefined or too large here."
    if code == "undecided":
        return (
            "The kernel cannot decide this design, and the fallback to the general executor is switched off."
        )
    return "The analysis of this design stopped with an error."
