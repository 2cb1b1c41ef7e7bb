"""The exact speed of a machine with a flywheel over its cycle, driven by a constant torque.

(J(q) + I) q'^2 / 2 = E_0 + int (T_m - S) dq, with J the machine's reduced inertia and S the effort of the drive besides
kinetic energy; E_0 gives the required mean speed over time. Where S depends on the speed (dampers, friction) the
computed speeds are inserted again until they converge. Eksergian, J. Franklin Inst. 209-211 (1930).

Mechanics: docs/theory.md 10.3.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.errors import AnalysisError
from dalembert.machine.flywheel.legendre_panels import Panels
from dalembert.machine.flywheel.turning_moment import TurningMoment

STAYS, MOST_ROUNDS = 1e-12, 60


@dataclass(frozen=True, eq=False)
class SpeedFluctuation(Compared):
    """Speeds (K, n) at the points of panels over a period; least and greatest with their angles; C_s of these.

    ``torque``: the constant driving torque T_m. ``residual``: difference of the torque of the computed motion,
    prescribed, from this torque less I alpha, over the largest torque.
    """

    inertia: float
    torque: float
    least: tuple[float, float]
    greatest: tuple[float, float]
    residual: float
    angle: Array = field(repr=False)
    speed: Array = field(repr=False)

    @property
    def fluctuation(self) -> float:
        """(w_max - w_min) over the mean of both."""
        return 2 * (self.greatest[0] - self.least[0]) / (self.greatest[0] + self.least[0])


def speed_fluctuation(t: TurningMoment, panels: Panels, reduced: Array, inertia: float) -> SpeedFluctuation:
    """Speed over the period with a flywheel of an inertia (kg m2); ``reduced``: J at the panels' points (K, n)."""
    q, total = panels.points.ravel(), reduced + inertia
    if not (total > 0).all():
        raise AnalysisError(
            "nothing in this machine has inertia: its speed is not determined; add a flywheel"
        )
    speed, acceleration = np.full(reduced.shape, abs(t.speed)), np.zeros(reduced.shape)
    for _ in range(MOST_ROUNDS):
        signed = np.sign(t.speed) * speed
        resisting = t.resistance(q, signed.ravel(), acceleration.ravel()).reshape(reduced.shape)
        torque = panels.mean(resisting)
        surplus = panels.antiderivative(torque - resisting)[0]
        corrected = _with_mean_speed(panels, total, surplus, abs(t.speed))
        moved = float(np.abs(corrected - speed).max()) / abs(t.speed)
        speed, square = corrected, corrected**2
        acceleration = (torque - resisting - panels.derivative(reduced) * square / 2) / total
        if moved < STAYS:
            break
    else:
        raise AnalysisError(
            f"the speed does not settle with a flywheel of {inertia:.4g} kg m2: after {MOST_ROUNDS} rounds it still "
            f"changes by {moved:.1e} of itself; give more inertia"
        )
    effort = t.effort(q, np.sign(t.speed) * speed.ravel(), acceleration.ravel()).reshape(reduced.shape)
    off = np.abs(effort + inertia * acceleration - torque).max() / max(float(np.abs(effort).max()), 1e-300)
    low, high = panels.extremes(speed)
    return SpeedFluctuation(inertia, torque, low, high, float(off), q, speed.ravel())


def _with_mean_speed(panels: Panels, inertia: Array, surplus: Array, mean: float) -> Array:
    """Speeds sqrt(2 (E_0 + given) / whole) with the required mean over time, period over int dq / q'."""
    start = float(np.max(-surplus)) if (surplus < 0).any() else 0.0
    energy = max(panels.mean(inertia) * mean**2 / 2, start * (1 + 1e-9) + 1e-300)
    for _ in range(200):
        square = 2 * (energy + surplus) / inertia
        if (square <= 0).any():
            raise AnalysisError(
                f"at {mean:.4g} rad/s mean speed the machine would come to rest within its cycle: give more inertia"
            )
        speed = np.sqrt(square)
        time, slope = panels.mean(1 / speed), -panels.mean(1 / (speed**3 * inertia))
        step = (1 / mean - time) / slope
        if abs(step) <= 1e-15 * abs(energy):
            return np.asarray(speed)
        energy = max(energy + step, (energy + start) / 2)
    return np.asarray(speed)


def inertia_for(
    t: TurningMoment, panels: Panels, reduced: Array, wanted: float, guess: float
) -> SpeedFluctuation:
    """The flywheel that gives just a C_s, by secants on 1 / C_s, nearly linear in I, from no flywheel up."""
    least = 1e-9 * max(float(reduced.max()), guess)
    here = speed_fluctuation(t, panels, reduced, max(guess, least))
    before = speed_fluctuation(t, panels, reduced, 1.1 * here.inertia)
    for _ in range(40):
        a, b = (1 / s.fluctuation for s in (before, here))
        if abs(here.fluctuation / wanted - 1) < 1e-11 or a == b:
            break
        next_ = max(here.inertia + (1 / wanted - b) * (here.inertia - before.inertia) / (b - a), least)
        if next_ == here.inertia:
            break
        before, here = here, speed_fluctuation(t, panels, reduced, next_)
    return here
