"""Motors: the effort of a drive as a function of its speed, switched on and off."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    list_schema,
    numbers,
    object_schema,
    stated_text,
    value_text,
)

EXAMPLE = "{stall: 40 N*m, no_load: 30 rad/s}, or {curve: {speed: [0 rpm, 900 rpm], torque: [40, 0]}}"
GEARING = {"ratio": 1.0, "inertia": 0.0, "efficiency": 1.0}
"""Keys of a motor behind a gear, with their defaults."""
LAG = "time_constant"
KEYS = ["stall", "no_load", "curve", "on", "off", *GEARING, LAG]
SWITCHES = ("time", "position", "speed")

Switch = tuple[str, float]
"""Variable that switches a motor, one of ``SWITCHES``, and its switching value."""


@dataclass(frozen=True, slots=True)
class MotorCurve:
    """Effort over speed by straight lines between points; beyond both ends the last line goes on if ``straight`` (given
    by stall and no-load), else the last effort holds. Off before ``on`` and from ``off``.

    Behind a gear its numbers are those of the motor's shaft: ``ratio`` n, its speed over that of the drive (of one that
    slides, rad/m); ``inertia`` J of its rotor, kg m2; ``efficiency`` of the gear. X = T - J n a is what its shaft gives
    to the gear, and the drive gets eta n X while power goes to the machine, n X/eta while it comes back.

    ``time_constant`` tau, s, L/R of its winding: the torque T follows its curve late, tau dT/dt = curve - T, from
    0 where it is switched on, and to 0 where it is switched off.
    """

    speed: tuple[float, ...]
    effort: tuple[float, ...]
    straight: bool = False
    on: Switch | None = None
    off: Switch | None = None
    ratio: float = 1.0
    inertia: float = 0.0
    efficiency: float = 1.0
    time_constant: float = 0.0

    @property
    def geared(self) -> bool:
        """True if the drive does not get the effort of the curve at its speed."""
        return (self.ratio, self.inertia, self.efficiency) != (1.0, 0.0, 1.0)

    @property
    def at_drive(self) -> MotorCurve:
        """Its curve as seen by the drive, behind a gear without inertia and loss."""
        return replace(
            self,
            speed=tuple(x / self.ratio for x in self.speed),
            effort=tuple(x * self.ratio for x in self.effort),
            ratio=1.0,
            inertia=0.0,
            efficiency=1.0,
        )

    @property
    def keys(self) -> dict[str, float]:
        """Its numbers by their keys in a file: of a curve none."""
        line = {"stall": self.effort[0], "no_load": self.speed[1]} if self.straight else {}
        late = {LAG: self.time_constant} if self.time_constant else {}
        return line | ({key: getattr(self, key) for key in GEARING} if self.geared else {}) | late

    def with_key(self, key: str, value: float) -> MotorCurve:
        """Another motor, its effort at rest or its free speed replaced."""
        if key == LAG or key in GEARING:
            return replace(self, **{key: value})  # type: ignore[arg-type]
        return replace(self, effort=(value, 0.0)) if key == "stall" else replace(self, speed=(0.0, value))

    @property
    def kinks(self) -> tuple[float, ...]:
        """Speeds at which its line has a corner."""
        return () if self.straight else self.speed

    @property
    def fastest(self) -> float:
        """The speed furthest from 0 that it has an effort for, with its sign."""
        return max(self.speed, key=abs)

    def at(self, speed: Array | float) -> Array | float:
        """Effort at a speed, switched on.

        >>> MotorCurve((0.0, 150.0), (40.0, 0.0), straight=True).at(75.0)
        20.0
        """
        import numpy as np

        if self.straight:
            return self.effort[0] * (1 - speed / self.speed[1])
        return np.asarray(np.interp(speed, self.speed, self.effort))[()]

    def line(self, speed: float, ahead: float) -> tuple[float, float]:
        """Effort at speed 0 and slope of the straight line it is on; at a corner of that which comes where the speed
        goes, with the sign of ``ahead``.

        >>> MotorCurve((0.0, 10.0, 20.0), (4.0, 4.0, 0.0)).line(10.0, 1.0)
        (8.0, -0.4)
        """
        import numpy as np

        near = 1e-9 * max(map(abs, self.speed))
        corner = min(abs(speed - x) for x in self.speed) <= near
        k = int(np.searchsorted(self.speed, speed + near * np.sign(ahead) if corner else speed))
        if not self.straight and k in (0, len(self.speed)):
            return self.effort[0 if k == 0 else -1], 0.0
        k = 1 if self.straight else k
        slope = (self.effort[k] - self.effort[k - 1]) / (self.speed[k] - self.speed[k - 1])
        return self.effort[k - 1] - slope * self.speed[k - 1], slope

    def tree(self, kind: str) -> dict[str, object]:
        """As a file says it."""
        kinds = of_kind(kind, self.ratio != 1.0)
        speeds = [value_text(x, kinds["speed"]) for x in self.speed]
        efforts = [value_text(x, kinds["effort"]) for x in self.effort]
        curve: dict[str, object] = {"speed": speeds, kinds["name"]: efforts}
        line: dict[str, object] = {"stall": efforts[0], "no_load": speeds[1]}
        tree: dict[str, object] = line if self.straight else {"curve": curve}
        for key, of in (("on", self.on), ("off", self.off)):
            if of is not None:
                tree[key] = stated_text(of[1], kinds[of[0]] if of[0] != "speed" else of_kind(kind)["speed"])
        for key, default, unit in (
            ("ratio", 1.0, "number"),
            ("inertia", 0.0, "inertia"),
            ("efficiency", 1.0, "number"),
            (LAG, 0.0, "time"),
        ):
            if getattr(self, key) != default:
                tree[key] = value_text(getattr(self, key), unit)
        return tree


def of_kind(kind: str, geared: bool = False) -> dict[str, str]:
    """Kinds of a motor's numbers, from that of its position; ``geared``: it turns, whatever its drive does."""
    turn = {"effort": "moment", "speed": "angular_speed", "name": "torque"}
    slide = {"effort": "force", "speed": "speed", "name": "force"}
    return (turn if kind == "angle" or geared else slide) | {"position": kind, "time": "time"}


def motor_curve(value: object, kind: str, rules: ReadingRules) -> MotorCurve:
    """The motor that a mapping describes; ``kind`` is that of the drive's position."""
    if isinstance(value, MotorCurve):
        return value
    keys = mapping(value, KEYS, f"motor: {EXAMPLE}")
    kinds = of_kind(kind, "ratio" in keys)
    further = (*_gearing(keys, kind, rules), _lag(keys, rules))
    line = {"stall", "no_load"} & set(keys)
    if ("curve" in keys) == bool(line) or (line and len(line) < 2):
        raise ModelError("a motor needs stall and no_load, or a curve", f"write motor: {EXAMPLE}")
    on, off = (
        at_item(k, switch, keys[k], of_kind(kind), rules) if k in keys else None for k in ("on", "off")
    )
    if "curve" in keys:
        speed, effort = at_item("curve", _curve, keys["curve"], kinds, rules)
        return MotorCurve(speed, effort, False, on, off, *further)
    stall = at_item("stall", rules.quantity, keys["stall"], kinds["effort"])
    free = at_item("no_load", rules.quantity, keys["no_load"], kinds["speed"])
    if not stall * free > 0:
        raise ModelError(
            f"a motor that stalls at {keys['stall']} and runs free at {keys['no_load']} does not drive",
            "give both the same sign, and neither 0: negative ones drive against the freedom",
            ("no_load",),
        )
    return MotorCurve((0.0, free), (stall, 0.0), True, on, off, *further)


def _gearing(keys: Mapping[str, object], kind: str, rules: ReadingRules) -> tuple[float, float, float]:
    """Ratio, inertia and efficiency."""
    ratio, inertia, efficiency = (
        at_item(key, rules.quantity, keys.get(key, default), unit)
        for key, default, unit in (
            ("ratio", 1.0, "number"),
            ("inertia", "0 kg*m^2", "inertia"),
            ("efficiency", 1.0, "number"),
        )
    )
    if not ratio > 0:
        what = f"the ratio of the gear is {ratio:g}"
        raise ModelError(what, "write the speed of the motor over that of the drive, such as 12", ("ratio",))
    if inertia < 0:
        raise ModelError("the inertia of the motor is negative", "write a positive one, or 0", ("inertia",))
    if not 0 < efficiency <= 1:
        what = f"the efficiency of the gear is {efficiency:g}"
        raise ModelError(what, "write a number above 0, and 1 at most, such as 0.9", ("efficiency",))
    if kind != "angle" and inertia and "ratio" not in keys:
        what = "a motor with inertia turns, and its drive slides"
        raise ModelError(
            what, "give the ratio, its angle over the length of the slide in rad/m", ("inertia",)
        )
    return ratio, inertia, efficiency


def _lag(keys: Mapping[str, object], rules: ReadingRules) -> float:
    """Time constant, s."""
    lag = at_item(LAG, rules.quantity, keys.get(LAG, "0 s"), "time")
    if lag < 0:
        what = "the time constant of the motor is negative"
        raise ModelError(
            what, "write the inductance of its winding over the resistance, such as 2 ms", (LAG,)
        )
    return lag


def _curve(value: object, kinds: Mapping[str, str], rules: ReadingRules) -> tuple[tuple[float, ...], ...]:
    keys = mapping(value, ["speed", kinds["name"]], f"curve: {{speed: [...], {kinds['name']}: [...]}}")
    for key in ("speed", kinds["name"]):
        if key not in keys:
            problem = f"the curve has no {key}"
            raise ModelError(problem, f"write curve: {{speed: [...], {kinds['name']}: [...]}}")
    speed = at_item("speed", _numbers, keys["speed"], kinds["speed"], rules)
    effort = at_item(kinds["name"], _numbers, keys[kinds["name"]], kinds["effort"], rules)
    if len(speed) != len(effort) or len(speed) < 2:
        what = f"the curve has {len(speed)} speeds and {len(effort)} values of {kinds['name']}"
        raise ModelError(what, "give lists of equal length, at least two values each", (kinds["name"],))
    for k, (a, b) in enumerate(pairwise(speed)):
        if not a < b:
            raise ModelError(
                f"speeds of the curve must increase: point {k + 2} is not at a greater speed than point {k + 1}",
                "give each speed once, rising",
                ("speed",),
            )
    return speed, effort


def _numbers(value: object, kind: str, rules: ReadingRules) -> tuple[float, ...]:
    """Numbers of a list."""
    if not isinstance(value, Sequence) or isinstance(value, str):
        raise ModelError("a curve is two lists", f"write motor: {EXAMPLE}")
    return numbers(value, kind, rules) if value else ()


def switch(value: object, kinds: Mapping[str, str], rules: ReadingRules) -> Switch:
    """A time, a position or a speed, as its unit says."""
    for by in SWITCHES:
        try:
            return by, rules.quantity(value, kinds[by])
        except ModelError:
            if not isinstance(value, str):
                break
    what = f"{value!r} says neither when, nor where, nor at which speed"
    raise ModelError(what, "write 0.5 s, 90 deg or 300 rpm")


def motor_schema() -> JsonSchema:
    """JSON schema of a motor in a file."""
    many = list_schema(NUMBER_OR_TEXT, 2)
    curve = {
        "speed": many | {"description": "rising speeds"},
        "torque": many | {"description": "of a turn, at each speed"},
        "force": many | {"description": "of a slide, at each speed"},
    }
    straight = {"description": "straight lines between points, constant beyond"}
    switched = "a time, a position or a speed at which it is switched "
    keys = {
        "stall": NUMBER_OR_TEXT | {"description": "effort at rest"},
        "no_load": NUMBER_OR_TEXT | {"description": "speed without effort; a straight line between"},
        "curve": object_schema(curve, "speed") | straight,
        "on": NUMBER_OR_TEXT | {"description": switched + "on"},
        "off": NUMBER_OR_TEXT | {"description": switched + "off"},
        "ratio": NUMBER_OR_TEXT | {"description": "speed of the motor over that of the drive; default 1"},
        "inertia": NUMBER_OR_TEXT | {"description": "of the rotor, about its axis; default 0"},
        "efficiency": NUMBER_OR_TEXT | {"description": "of the gear, in both directions; default 1"},
        LAG: NUMBER_OR_TEXT | {"description": "L/R of its winding, by which its torque is late; default 0"},
    }
    return object_schema(keys)
