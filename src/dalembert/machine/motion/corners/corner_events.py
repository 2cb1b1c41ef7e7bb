"""Switches of loads and efforts along a motion: their sides at the start, going over, and jumps that hold the machine.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.corners.elastic_joints import ElasticState
from dalembert.machine.motion.corners.one_sided import Sided, has_corners
from dalembert.machine.motion.equation import LoadChannel, StoppedError
from dalembert.machine.motion.occurrences import Guard, Value, Words
from dalembert.model import Mechanism
from dalembert.model.quantities.expressions import Expression

AHEAD = 1e-7
"""Part of the characteristic time of the machine's motion, after which the direction of a switch is evaluated."""
CLEAR = 1e-13
"""Radians, or sizes of a link, by which a start is beyond the corners that it is at."""
OFTEN, SOONER, LATER = 1e-3, 0.97, 41
"""A switch that alternates within less than this part of that time, and by this factor sooner than that many times
before, is a jump at which the machine comes to rest."""
HOLDS = "jumps at this state and pushes back from both sides: it holds the machine at a value between its two limits"
DRY = (
    "jumps with a speed and pushes back from both sides, as dry friction does: write it as `brake:` of the drive, or "
    "as friction of its joint, which hold at rest"
)


@dataclass
class Switch:
    """Something of a load or effort (``what``) that switches where a value passes zero; ``beyond``: of a table, whether
    it is past one of its ends; ``words``: what an event says of it, once it has gone over; ``nests``: its value may
    depend on the sides of others, as that of `max(0, sign(x))`."""

    what: str
    value: Value
    side: Callable[[], float]
    flip: Callable[[float], None]
    beyond: Callable[[], bool] = lambda: False
    words: Callable[[float, Array], Words] = lambda t, y: ()
    nests: bool = True
    passed: list[float] = field(default_factory=list)


class CornerState(ElasticState):
    """A motion whose loads and efforts have corners, each ``switching`` on one side."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.switching: list[Switch] = []
        self.gone_over = np.nan  # when something last did
        loads = [n for n, x in m.loads.items() if any(map(has_corners, getattr(x, "varying", ())))]
        self._loads = f"load {' or '.join(map(repr, loads))}"

    def _acting_sides(self) -> Iterator[tuple[Sided, Callable[[float, Array], dict[str, float]]]]:
        """Loads and efforts that depend on drives, speeds and time, with their variables at a state."""
        d = self.d
        for channel in self.equation.channels:
            if isinstance(channel, LoadChannel) and channel.sided is not None:
                yield channel.sided, partial(self._known_of, channel)
        for sided in getattr(self.acting, "own", self.acting).switched_efforts:
            yield sided, lambda t, y: self.acting.known(t, y[:d], y[d : 2 * d])
        for j, elastic in self.elastic_joints.items():
            yield elastic, partial(self._known_of_joint, j)

    def _known_of_joint(self, j: int, t: float, y: Array) -> dict[str, float]:
        return self.joint_motion(j, self.equation(t, y[: self.d], y[self.d : 2 * self.d]))

    def _known_of(self, channel: LoadChannel, t: float, y: Array) -> dict[str, float]:
        return channel.known(t, y[: self.d])

    def _traced_sides(self) -> Iterator[Switch]:
        """Loads in machine code, whose sides are numbers of the equation."""
        d, values = self.d, self.equation.values

        def value(j: int) -> Value:
            return lambda t, y: float(self.equation(t, y[:d], y[d : 2 * d]).corners[j])

        for j, place in enumerate(self.equation.sides):
            yield Switch(
                self._loads, value(j), partial(values.item, place), partial(values.__setitem__, place)
            )

    def _switches_of(
        self, sided: Sided, known: Callable[[float, Array], dict[str, float]]
    ) -> Iterator[Switch]:
        """Switches of a load or effort that has been evaluated."""

        def value(k: int) -> Value:
            return lambda t, y: sided.switch(k, known(t, y))

        def words(k: int) -> Callable[[float, Array], Words]:
            return lambda t, y: sided.words(k, known(t, y))

        for k in range(len(sided.switches)):
            side, flip = partial(sided.side, k), partial(sided.flip, k)
            nests = isinstance(sided.value, Expression)
            yield Switch(sided.what, value(k), side, flip, lambda: sided.beyond, words(k), nests)

    def take_sides(self, t: float, y: Array) -> None:
        """The sides on which all switches are at a state."""
        acting, traced = list(self._acting_sides()), list(self._traced_sides())
        for sided, known in acting:
            sided.sides.clear()
            sided.at(known(t, y))
        for switch in traced:  # the inner ones of an expression first
            switch.flip(float(np.sign(switch.value(t, y))))
        self.switching = [*(s for each in acting for s in self._switches_of(*each)), *traced]

    def _yields(self, t: float, y: Array) -> bool:
        self.take_sides(t, y)  # of what goes by time, while all rests
        return super()._yields(t, y)

    def find_sides(self, t: float, y: Array) -> None:
        """Sides at the start; where something is right at its corner, those that the motion goes to."""
        self.take_sides(t, y)
        corners = [switch for switch in self.switching if switch.side() == 0]
        for switch in corners:
            if switch.side() == 0:
                ahead = self._ahead(switch, t, y)
                self._flip(switch, float(np.sign(ahead)), t, y)
                if self._ahead(switch, t, y) * ahead < 0:
                    raise StoppedError(f"{switch.what} {HOLDS}")
        if corners:
            self._leave_corners(t, y)

    def _leave_corners(self, t: float, y: Array) -> None:
        """Go on by so little that all that analyse the start see the sides that the motion goes to."""
        moved = np.where(self.acting.free, self.soon(t, y)[1][: self.d] - y[: self.d], 0.0)
        if (largest := float(np.abs(moved / self.lengths).max())) > 0:
            y[: self.d] += CLEAR / largest * moved

    def _flip(self, switch: Switch, side: float, t: float, y: Array) -> None:
        """Take a switch to a side, and others whose values jump with it to those that they are on then."""
        nested = [s for s in self.switching if s.nests and s is not switch]
        before = [s.value(t, y) for s in nested]
        switch.flip(side)
        for other, was in zip(nested, before, strict=True):
            now = other.value(t, y)
            if now != was and now * other.side() <= 0:
                self._flip(other, float(np.sign(now or self._ahead(other, t, y))), t, y)

    def _ahead(self, switch: Switch, t: float, y: Array) -> float:
        """Change of a switch over a short time, all sides unchanged."""
        return switch.value(*self.soon(t, y)) - switch.value(t, y)

    def soon(self, t: float, y: Array) -> tuple[float, Array]:
        """A time shortly behind a state, and the state then."""
        rate, short, d = np.nan_to_num(self.rate(t, y)), AHEAD / self.pace(t, y), self.d
        later = y + short * rate
        later[:d] += short**2 / 2 * rate[d : 2 * d]
        return t + short, later

    def pace(self, t: float, y: Array) -> float:
        """Natural pace at a state, 1/s."""
        raise NotImplementedError

    def corner_guards(self) -> list[Guard]:
        """Switches whose going over ends a segment."""
        return [Guard("corner", j, s.value, s.side()) for j, s in enumerate(self.switching)]

    def go_over(self, g: Guard, t: float, y: Array) -> None:
        """Take a switch to its other side; StoppedError where its jump pushes back at once."""
        switch = self.switching[g.which]
        if t == self.gone_over and switch.value(t, y) * g.side > 0:
            return  # a switch inside it has gone over at this instant too, and it keeps its side
        self.gone_over = t
        self._flip(switch, -g.side, t, y)
        faster = y.copy()
        faster[self.d : 2 * self.d] *= 1 + AHEAD
        faster[self.d : 2 * self.d] += AHEAD * self.pace(t, y)
        if switch.value(t, faster) != switch.value(t, y) and self._ahead(switch, t, y) * g.side > 0:
            raise StoppedError(f"{switch.what} {DRY}")
        if words := switch.words(t, y):
            self.note(t, "stop", *words)
        if switch.beyond():
            self.note(t, "table end", f"{switch.what} is beyond the end of its table from here on")
        switch.passed.append(t)
        one, other = (
            switch.passed[k] - switch.passed[k - 2] if len(switch.passed) > -k + 1 else np.inf
            for k in (-1, -LATER)
        )
        if one * self.pace(t, y) < OFTEN and one < SOONER * other < np.inf:
            raise StoppedError(f"{switch.what} {HOLDS}; it passes the jump ever sooner")
