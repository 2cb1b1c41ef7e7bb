"""The motion of the links in a result: their angles, rotations, points and mass centres, with their rates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.methods.on_paper import OnPaper
from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.model import Mechanism


Rate = Literal["", "speed", "acceleration"]
"""Value or rate of a coordinate, the value by default."""

ORIGIN = "origin"
"""The point of a link where its axes begin, beside its named points and its mass centre."""


def place_of(names: tuple[str, ...], name: str, kind: str) -> int:
    """The number of a name, refused with those there are."""
    if name not in names:
        raise ModelError(f"unknown {kind} {name!r}", f"choose among {', '.join(names) or 'none'}")
    return names.index(name)


class LinkMotion(OnPaper):
    """Motion of the links of a result; the arrays are those of ``Result``."""

    compiled: Compiled
    point_array: Array
    turn_array: Array
    rotation_array: Array
    twist_array: Array
    acceleration_array: Array

    @property
    def mechanism(self) -> Mechanism:
        """The description that was analysed."""
        return self.compiled.mechanism

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the moving links."""
        return self.compiled.links

    @property
    def _d(self) -> int:
        """Components of a force."""
        return int(self.compiled.layout.algebra.d)

    def slide(self, joint: str, rate: Rate = "") -> Array:
        """Slide of a joint (P,), m, or its `speed` or `acceleration`: `slide.JOINT.RATE`."""
        return self._named("slide", joint, rate)

    def turn(self, joint: str, rate: Rate = "") -> Array:
        """Turn of a joint (P,), rad, or its `speed` or `acceleration`: `turn.JOINT.RATE`."""
        return self._named("turn", joint, rate)

    def drive(self, name: str, rate: Rate = "") -> Array:
        """Position of a drive (P,), or its `speed` or `acceleration`: `drive.NAME.RATE`."""
        return self._named("drive", name, rate)

    def _named(self, *name: str) -> Array:
        result: Any = self
        return np.asarray(result[".".join(filter(None, name))])

    def angle(self, link: str, rate: Rate = "") -> Array:
        """Angle of a link's x axis to ground's (P,), followed through full turns, or its `speed` or `acceleration`; in
        space ask ``rotation``.

        Where a load depends on it, the full turns are those that the load counts.
        """
        if rate:
            return self._named("angle", link, rate)
        if self._d == 3:
            raise ModelError(f"link {link!r} has no single angle in space", "ask its rotation")
        return np.asarray(self.turn_array[..., self._link(link)] + self._counted(f"links.{link}.angle"))

    def _counted(self, name: str) -> Numeric:
        """Whole turns of an angle as loads count it."""
        return self.compiled.pose_turns.get(name, 0.0)

    def rotation(self, link: str) -> Array:
        """Matrices (P, d, d) that turn components in a link's axes into components in ground axes."""
        r = self.rotation_array[..., self._link(link), :]
        if self._d == 2:
            r = np.stack([r[..., 0], -r[..., 1], r[..., 1], r[..., 0]], axis=-1)
        return np.asarray(r.reshape((*r.shape[:-1], self._d, self._d)))

    def speed(self, link: str) -> Array:
        """Angular velocity of a link (P,), in space (P, 3), rad/s."""
        return self._turning(self.twist_array, link)

    def acceleration(self, link: str) -> Array:
        """Angular acceleration of a link (P,), in space (P, 3), rad/s2."""
        return self._turning(self.acceleration_array, link)

    def _turning(self, rates: Array, link: str) -> Array:
        turning = rates[..., self._link(link), self._d :]
        return np.asarray(turning[..., 0] if self._d == 2 else turning)

    def position(self, link: str) -> Array:
        """Origin of a link's axes (P, d)."""
        return self._place(link, np.zeros(self._d))

    def velocity(self, link: str) -> Array:
        """Velocity of the origin of a link's axes (P, d)."""
        return self._velocity(link, np.zeros(self._d))

    def center(self, link: str) -> Array:
        """Mass centre of a link (P, 2)."""
        return self._place(link, np.array(self.mechanism.center(link)))

    def center_velocity(self, link: str) -> Array:
        """Velocity of a link's mass centre (P, 2)."""
        return self._velocity(link, np.array(self.mechanism.center(link)))

    def center_acceleration(self, link: str) -> Array:
        """Acceleration of a link's mass centre (P, 2)."""
        return self._acceleration(link, np.array(self.mechanism.center(link)))

    def point(self, link: str, name: str, rate: Literal["", "velocity", "acceleration"] = "") -> Array:
        """A named point of a link (P, 2), ground axes, or its `velocity` or `acceleration`."""
        if rate:
            return self._named("point", link, name, rate)
        return self._place(link, self._point(link, name))

    def point_velocity(self, link: str, name: str) -> Array:
        """Velocity of a named point of a link (P, 2)."""
        return self._velocity(link, self._point(link, name))

    def point_acceleration(self, link: str, name: str) -> Array:
        """Acceleration of a named point of a link (P, 2)."""
        return self._acceleration(link, self._point(link, name))

    def _link(self, link: str) -> int:
        return place_of(self.links, link, "link")

    def _point(self, link: str, name: str) -> Array:
        if name == ORIGIN and name not in self.mechanism.points(link):
            self._link(link)
            return np.zeros(self._d)
        return point_of(self.mechanism, link, name)

    def _arm(self, link: str, u: Array) -> tuple[int, Array]:
        k, c = self._link(link), self.compiled
        return k, c.layout.algebra.rotate(self.rotation_array[..., k, :], u - c.layout.reference[k])

    def _place(self, link: str, u: Array) -> Array:
        k, r = self._arm(link, u)
        return np.asarray(self.point_array[..., k, :] + r + self.compiled.origin)

    def _velocity(self, link: str, u: Array) -> Array:
        (k, r), g = self._arm(link, u), self.compiled.layout.algebra
        return np.asarray(self.twist_array[..., k, : g.d] + g.spin(self.twist_array[..., k, g.d :], r))

    def _acceleration(self, link: str, u: Array) -> Array:
        (k, r), g = self._arm(link, u), self.compiled.layout.algebra
        rate, w = self.acceleration_array[..., k, :], self.twist_array[..., k, g.d :]
        return np.asarray(rate[..., : g.d] + g.spin(rate[..., g.d :], r) + g.centripetal(w, r))
