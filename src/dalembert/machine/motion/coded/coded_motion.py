"""A motion in machine code: where it is smooth, and which of its steps a guard has to look at.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.coded.steps import Integrator
from dalembert.machine.motion.coordinates.dead_centres import LeadState
from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.occurrences import TURNING, Guard
from dalembert.machine.motion.rest.dry_friction import sided
from dalembert.model import Mechanism

Coded = tuple[Integrator, Array]
"""Machine code, and the values it runs with."""
SHORT = 1e-6
"""Part of a step by which a state is before its end, for the trend of a guard."""


class CodedState(LeadState):
    """``coded``: of the segment that runs; ``careful``: True while friction needs the solution in numpy; ``longest``:
    step so far, where a segment is continued."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.coded: Coded | None = None
        self.careful, self.longest = False, 0.0
        self.forget()
        self.bearing = 0.0
        self.sided = sided(self.equation.dry.contacts) if self.equation.dry else np.zeros(0, int)

    def forget(self) -> None:
        """Watched values at the last state, when senses may differ."""
        self.seen: tuple[tuple[float, bytes], Array] = (np.nan, b""), np.zeros(0)

    def machine(self, t: float, y: Array) -> Coded | None:
        """Machine code and its values, where the efforts are straight lines of the speeds until the next event."""
        free = self.acting.free & ~self.locked
        rough = self.pressed or self.elastic_joints or self.acting.laws or self.careful
        if rough or (self.stuck.any() and free.sum() < 2):
            return None
        bent = any(motor.kinks for motor in self.acting.motors.values())
        ahead = self.at(t, y)[0] if bent else np.zeros(self.d)
        lines = self.acting.lines(y[self.d : 2 * self.d], ahead)
        code = None if lines is None else self.equation.steps(free)
        if code is None or lines is None:
            return None
        brake = -self.acting.brake * self.toward * free
        prescribed = np.where(self.acting.free, 0.0, self.acting.acceleration)
        contacts = [self.sense, self.own(self.stuck)] if self.equation.dry else []
        return code, np.concatenate([self.equation.values, *lines, brake, prescribed, *contacts])

    def rate(self, t: float, y: Array) -> Array:
        """Time derivative of the state."""
        if self.coded is None:
            return super().rate(t, y)
        return np.asarray(self.coded[0].rates(self.coded[1], t, y[None])[0])

    def _watched(self, t: float, y: Array) -> Array:
        """Values that the machine code watches; in numpy the margins of contacts, with those of the last state kept."""
        if self.seen[0] == (t, y.tobytes()):
            return self.seen[1]
        found = np.zeros(2 * len(self.sided))  # no sides where there is no motion
        if self.coded is not None:
            found = self.coded[0].rates_watched(self.coded[1], t, y[None])[1][0]
        else:
            with suppress(StoppedError):
                found = self.solved(t, y)[0].margins
        self.seen = (t, y.tobytes()), found
        return found

    def margins(self, t: float, y: Array) -> Array:
        """Margins (2K,) of the contacts that bear on one of two sides; the largest of all is kept."""
        first = len(self.sense) if self.coded is not None else 0
        found = self._watched(t, y)[first : first + 2 * len(self.sided)]
        self.bearing = max(self.bearing, float(np.abs(found).max()))
        return found

    def rubbing_rates(self, t: float, y: Array) -> Array:
        """Rates of the contacts that slip by themselves."""
        if self.coded is None or not self.equation.dry:
            return super().rubbing_rates(t, y)
        return self._watched(t, y)[: len(self.sense)]

    def room(self, t: float, y: Array) -> Array:
        """Margin of friction of the independent contacts that stick."""
        if self.coded is None:
            return self.own(self.solved(t, y)[0].room)
        first = len(self.sense) + 2 * len(self.sided)
        return self._watched(t, y)[first : first + len(self.sense)]

    def quiet(self, records: Array, watched: Array, guards: Sequence[Guard]) -> int:
        """Number of steps before the first at which a guard may change its sign."""
        if any(g.column < 0 or not (g.side or g.kind == "side") for g in guards):
            return 0
        assert self.coded is not None
        code, values = self.coded
        n, columns = code.n, [g.column for g in guards]
        after = np.column_stack([records[:, 2 + n : 2 + 2 * n], watched])
        for g in guards:
            clear = after[np.abs(after[:, g.column]) > g.least, g.column] if not g.side else after[:0, 0]
            g.side = float(np.sign(clear[0])) if clear.size else g.side
        level, side, least = np.array([[g.level, g.side, g.least] for g in guards]).reshape(-1, 3).T
        now = (after[:, columns] - level) * side
        meets = ~(now >= -least).all(axis=1)
        turning = [k for k, g in enumerate(guards) if g.kind in TURNING]
        if turning:
            short = SHORT * records[:, 1]
            t, rates = records[:, 0] + records[:, 1] - short, records[:, 2 + 3 * n : 2 + 4 * n]
            y = after[:, :n] - short[:, None] * rates
            before = np.column_stack([y, code.rates_watched(values, t, y)[1]])
            trend = now[:, turning] - ((before[:, columns] - level) * side)[:, turning]
            came = np.vstack([[guards[k].trend for k in turning], trend[:-1]])
            meets |= ((came < 0) & (trend > 0)).any(axis=1)
        count = int(np.argmax(meets)) if meets.any() else len(meets)
        for k, of in enumerate(turning):
            guards[of].trend = float(trend[count - 1, k]) if count else guards[of].trend
        return count
