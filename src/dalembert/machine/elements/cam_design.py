"""`da.cam`: the form of a cam, its pressure angle and curvature, and the limits of its size.

Source: Norton, Design of Machinery, chapter 8; Rothbart, Cam Design Handbook. Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from dalembert.algebra import plane
from dalembert.algebra.extremes import least_within
from dalembert.analysis.compile.elements.cam_limits import least_size
from dalembert.analysis.compile.elements.cam_motion import CamMotion, CamPlace, cam_motion, lift_sign
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree
from dalembert.core.elements.cam_curves import TURN
from dalembert.errors import ModelError
from dalembert.machine.elements.hertz_contact import LineContact, hertz_line
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.model.joints.elements.cams import Cam
from dalembert.printing import Part
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

Of = Callable[[Array], Array]


@dataclass(frozen=True, repr=False, eq=False)
class CamDesign(Drawn, Labelled, Worked):
    """A cam over a turn th on the link that carries it and its follower, counted in its sense from the turn of its link
    against that one.

    turn (T,): even turns with all joints of pieces. Lift and its derivatives over th in rad: m, or rad of a follower
    that swings, in the sense of its freedom; curvature radii > 0 where convex; pressure angle > 0 where the normal
    leans against the cam's sense.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> c = da.cam(da.load(examples()["carton_pusher"]), "F")
    >>> c.turn.shape
    (365,)
    """

    ROWS: ClassVar[str] = "places"

    mechanism: Mechanism
    joint: str
    motion: CamMotion
    count: int = field(default=361)

    @cached_property
    def turn(self) -> Array:
        """Turns (T,), rad: even ones and joints of pieces."""
        return self.motion.turns(self.count)

    @property
    def joins(self) -> Array:
        """Turns at which pieces of the lift join, rad, without the start."""
        return self.motion.joins

    @cached_property
    def _all(self) -> CamPlace:
        return self.motion.at(self.turn)

    # at turns of the cam

    def lift(self, th: Array | float, before: bool = False) -> Array:
        """Lift and its first three derivatives over the turn (4, ...); at a joint behind it, or just ``before``."""
        p, least = self.motion.at(np.ravel(th), before), self._least
        sign = lift_sign(self.motion)
        jerk = self.motion.jerk(np.ravel(th))
        return np.asarray(
            np.stack([sign * (p.y - least), sign * p.slope, sign * p.bend, sign * jerk]).reshape(
                4, *np.shape(th)
            )
        )

    @cached_property
    def _least(self) -> float:
        """The follower's place at its lowest."""
        if self._joint.profile.segments is not None:
            return float(self.motion.height(np.zeros(1))[0])
        return -self._extreme(lambda t: -self.motion.at(t).y)[0]

    def pitch(self, th: Array | float) -> Array:
        """Curve of the follower's point (..., 2) in the cam's axes from its axis of turning, m; of a flat face, of its
        point of contact."""
        turns = np.ravel(np.asarray(th, float))
        return self.motion.in_cam(turns, self._touching(self.motion.at(turns))).reshape(*np.shape(th), 2)

    def profile(self, th: Array | float) -> Array:
        """The cam's outline (..., 2) in its axes from its axis of turning, where it touches at these turns, m."""
        turns = np.ravel(np.asarray(th, float))
        p = self.motion.at(turns)
        at = self._touching(p) - self._joint.follower.roller * p.normal
        return self.motion.in_cam(turns, at).reshape(*np.shape(th), 2)

    def _touching(self, p: CamPlace) -> Array:
        return np.asarray(p.point - p.place[:, None] * plane.across(p.normal))

    def pressure_angle(self, th: Array | float) -> Array:
        """Angle (...) from the motion of the place of contact to the normal, rad, > 0 against the cam's sense."""
        return self._pressure(self.motion.at(np.ravel(th))).reshape(np.shape(th))

    def _pressure(self, p: CamPlace) -> Array:
        across = plane.cross(p.way, p.normal)[:, 0]
        return np.asarray(self.motion.sense * np.arctan2(across, (p.way * p.normal).sum(axis=-1)))

    def pitch_radius(self, th: Array | float) -> Array:
        """Radius of curvature (...) of the curve of the follower's point, of a face's cam itself, m; > 0 convex."""
        turns = np.ravel(th)
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / self.motion.curvature(turns, self.motion.at(turns))).reshape(np.shape(th))

    def profile_radius(self, th: Array | float) -> Array:
        """Radius of curvature (...) of the cam's outline, m; > 0 convex."""
        return self.pitch_radius(th) - self._joint.follower.roller

    # measures over a turn

    def _extreme(self, of: Of) -> tuple[float, float]:
        """Largest value of a function of turns, and its place."""
        values = of(self.turn)
        if not np.isfinite(values).any():
            return np.nan, np.nan
        top = float(np.nanmax(values))
        k = int(np.argmax(values >= top - 1e-9 * abs(top)))  # the first of equal ones
        best, at = float(values[k]), float(self.turn[k])
        first = np.arange(
            max(k - 1, 0), min(k + 1, len(self.turn) - 1)
        )  # beside the joints of pieces, not on them
        lower, place = least_within(lambda t: -of(t), self.turn[first] + 1e-9, self.turn[first + 1] - 1e-9)
        if len(first) and -lower.min() > best + 1e-12 * abs(best):
            best, at = float(-lower.min()), float(place[int(np.argmin(lower))])
        return best, at

    @cached_property
    def highest(self) -> tuple[float, float]:
        """Greatest lift and its turn."""
        top, at = self._extreme(lambda t: self.motion.at(t).y)
        return top - self._least, at

    def _rising(self, turns: Array) -> Array:
        p = self.motion.at(turns)
        return np.where(p.slope > 1e-9 * self._steepest, np.abs(self._pressure(p)), np.nan)

    @cached_property
    def _steepest(self) -> float:
        return float(np.abs(self._all.slope).max())

    @cached_property
    def _peak(self) -> tuple[float, float]:
        return self._extreme(self._rising)

    @property
    def pressure_angle_peak(self) -> float:
        """Greatest pressure angle while the follower rises, rad."""
        return self._peak[0]

    @property
    def pressure_angle_peak_at(self) -> float:
        """Turn of the cam at this lift, rad."""
        return self._peak[1]

    @property
    def pressure_angle_return(self) -> float:
        """Greatest pressure angle while it returns, rad."""

        def falling(turns: Array) -> Array:
            p = self.motion.at(turns)
            return np.where(p.slope < -1e-9 * self._steepest, np.abs(self._pressure(p)), np.nan)

        return self._extreme(falling)[0]

    @cached_property
    def _sharpest(self) -> tuple[float, float]:
        return self._extreme(lambda t: self.motion.curvature(t, self.motion.at(t)))

    @property
    def least_convex_radius(self) -> float:
        """Least convex radius of the curve of the follower's point, of a flat face's cam itself, m."""
        return 1.0 / self._sharpest[0]

    @property
    def least_convex_radius_at(self) -> float:
        """Turn of the cam at this value, rad."""
        return self._sharpest[1]

    @property
    def largest_roller(self) -> float:
        """Radius from which on a roller undercuts the cam, m; NaN of a flat face."""
        return np.nan if self._joint.flat else self.least_convex_radius

    @cached_property
    def _size(self) -> tuple[float, float]:
        return least_size(self.mechanism, self.joint, self.motion)

    @property
    def least_base(self) -> float:
        """Base radius from which on the cam is not undercut, m; NaN of a profile that is not given by its lift."""
        return self._size[0]

    @property
    def least_base_at(self) -> float:
        """The turn at which a smaller one undercuts first, rad."""
        return self._size[1]

    @property
    def face_half_width(self) -> float:
        """Largest distance of the contact from the follower's point along a flat face, m."""
        return self._extreme(lambda t: np.abs(self.motion.at(t).place))[0]

    @property
    def nose_distance(self) -> float:
        """Distance of the nose's centre from the axis of a tangent cam, m."""
        return np.nan if self._joint.profile.tangent is None else self._joint.profile.tangent.nose_distance

    @property
    def nose_radius(self) -> float:
        """Nose radius of a tangent cam, m."""
        return np.nan if self._joint.profile.tangent is None else self._joint.profile.tangent.nose_radius

    @property
    def _joint(self) -> Cam:
        return self.motion.joint

    # with the forces of the machine

    @cached_property
    def result(self) -> Result:
        """Dynamics of the mechanism at its positions, with a contact that pushes and pulls."""
        from dalembert.analysis.solution import dynamics
        from dalembert.model.joints.contact_keys import HOLDS

        part = self._joint.model_copy(update={"contact": HOLDS})
        m = self.mechanism
        return dynamics(m.model_copy(update={"joints": {**m.joints, self.joint: part}}))

    @cached_property
    def force(self) -> Array:
        """Normal force (P,) at the mechanism's positions, N; below 0 where the follower would have to be pulled."""
        from dalembert.analysis.methods.cam_contacts import normal_force

        return normal_force(self.result, self.joint)

    @property
    def changes(self) -> Array:
        """Positions (n,) of the first drive at which the normal force changes its sign: a follower in a groove goes
        over to its other wall."""
        changes = self.result.contact(self.joint).changes
        assert changes is not None
        return changes

    @property
    def lift_speed(self) -> float:
        """Speed of the first drive from which on the follower leaves the cam, rad/s or m/s."""
        from dalembert.analysis.solution import dynamics

        return dynamics(self.mechanism).contact(self.joint).lift_speed

    def spring_for(self, preload: float | None = None, least: float = 0.0) -> tuple[float, float]:
        """Stiffness and preload of a spring along the follower's motion that keeps the normal force at ``least``.

        N/m and N, or N m/rad and N m of a follower that swings; with neither given the softest spring by its greatest
        force: min of preload + k h. Raises ModelError where no spring does.
        """
        from dalembert.machine.elements.follower_spring import spring_for

        return spring_for(self, preload, least)

    def hertz(
        self, width: float | None = None, elasticity: float | None = None, force: float | None = None
    ) -> LineContact:
        """Greatest pressure between cam and follower at the mechanism's positions, or under a force at the sharpest
        place: `da.hertz_line`. Width and elasticity default to those of the joint, SI."""
        width = width if width is not None else self._joint.face_width
        elasticity = elasticity if elasticity is not None else self._joint.elasticity or 206e9
        if width is None:
            raise ModelError(
                f"the width of cam {self.joint!r} is not known", "give width, or face_width in the file"
            )
        if self._joint.follower.kind == "knife":
            raise ModelError(
                "a knife edge has no radius: its pressure is without limit", "take a roller or a face"
            )
        inner = self._joint.follower.roller or np.inf
        if force is not None:
            radius = self.least_convex_radius - (0.0 if self._joint.flat else inner)
            return hertz_line(force, width, (radius, inner), elasticity, self._joint.poisson)
        turns = self.turns_of(self.result)
        radii = self.profile_radius(turns)
        out = [
            hertz_line(float(n), width, (float(r), inner), elasticity, self._joint.poisson)
            for n, r in zip(self.force, radii, strict=True)
            if n > 0
        ]
        if not out:
            what = f"no force presses the follower on cam {self.joint!r} at any position"
            raise ModelError(what, "give force, or a spring that keeps it on: spring_for")
        return max(out, key=lambda x: x.pressure)

    def turns_of(self, r: Result) -> Array:
        """Turns (P,) of the cam, in its sense, at the positions of a result."""
        cam, link = self._joint.links[0], self.motion.carrier.link
        carrier = 0.0 if link == "ground" else r.angle(link)
        return np.asarray(
            np.mod(self.motion.sense * (r.angle(cam) - carrier - self._joint.profile.start), TURN)
        )

    # as an answer

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Turn, lift and its derivatives, pressure angle, curvature radius, outline."""
        from dalembert.machine.elements import cam_text

        return cam_text.columns(self)

    def record(self, to: Scale) -> Tree:
        """Measures over a turn."""
        from dalembert.machine.elements import cam_text

        return cam_text.record(self, to)

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Sentences about its form, and its measures."""
        from dalembert.machine.elements import cam_text

        return cam_text.contents(self, self.scale(units))

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The cam to scale where its pressure angle is greatest, and charts over its turn."""
        from dalembert.views.plane.elements.cam_view import cam_scenes

        return cam_scenes(self, notation)

    @property
    def jumps(self) -> Array:
        """Turns at which the acceleration jumps, rad."""
        places = np.array([0.0, *self.joins])
        behind, before = self.motion.at(places).bend, self.motion.at(places, before=True).bend
        size = float(np.abs(self._all.bend).max())
        return np.asarray(places[np.abs(behind - before) > 1e-6 * size])

    def save(self, path: str | os.PathLike[str], *args: Any, **options: Any) -> None:
        """Write the outline to .dxf or .csv, 1:1 in the file's unit; another ending writes the answer.

        A closed polyline within ``tolerance`` (m, default 1e-6) of the outline; ``cutter``: radius (m) of a cutter
        whose centre's path is written besides, on a separate layer.
        """
        from dalembert.machine.elements.cam_files import save_outline

        tolerance, cutter = options.pop("tolerance", 1e-6), options.pop("cutter", None)
        if os.fspath(path).lower().endswith((".dxf", ".csv")):
            save_outline(self, os.fspath(path), tolerance, cutter, **options)
            return
        super().save(path, *args, **options)


def cam(m: ModelOrPath, joint: str, count: int = 361) -> CamDesign:
    """The form and the measures of a cam of a mechanism; raises ModelError where it has none of that name.

    >>> import dalembert as da
    >>> at = {"ground": "O", "cam": "O", "valve": "F"}
    >>> links = {link: {"points": {point: [0, 0]}} for link, point in at.items()}
    >>> slide = {"type": "slider", "links": ["ground", "valve"], "at": ["O", "F"], "direction": 90}
    >>> disc = {"eccentric": "12 mm", "radius": "40 mm"}
    >>> on = {"type": "cam", "links": ["cam", "valve"], "at": ["O", "F"], "follower": {"roller": "10 mm"}}
    >>> joints = {"O": {"type": "pin", "links": ["ground", "cam"]}, "S": slide, "F": on | {"profile": disc}}
    >>> m = da.mechanism({"links": links, "joints": joints, "drives": {"O": {"position": 0}}})
    >>> c = da.cam(m, "F")
    >>> round(float(c.lift(3.141592653589793)[0]), 6), round(c.least_convex_radius, 6)
    (0.010539, 0.05)
    """
    m = as_mechanism(m)
    cams = [name for name, j in m.joints.items() if isinstance(j, Cam)]
    if joint not in cams:
        what = f"joint {joint!r} is not a cam" if joint in m.joints else f"unknown joint {joint!r}"
        raise ModelError(what, closest(joint, cams) if cams else "the mechanism has no cam")
    return CamDesign(m, joint, cam_motion(m, joint), count)
