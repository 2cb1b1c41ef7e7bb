"""`r.plot("effort.O2")` and `r.polar("A")`: quantities by name as a drawing, or on axes of matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from operator import methodcaller
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.plane_only import refuse_space
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.views.charts import along, polar_chart, polar_path, stepped_series
from dalembert.views.not_shown import refuse_still
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import stack_scenes
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.batch.design_sweep import Sweep
    from dalembert.analysis.result.result import Result


class Curves(NamedTuple):
    """Curves against one axis, in the units that its labels name."""

    x: Array
    x_label: str
    angle: bool
    series: Mapping[str, Array]
    y_label: str
    title: str

    def draw(self, ax: Any = None) -> Any:
        """Draws a Scene, or on given axes of matplotlib and returns them. Curves have gaps where values are missing."""
        if ax is None:
            return curves_scene(self.x, self.series, self.x_label, self.y_label, self.title, self.angle)
        for name, curve in self.series.items():
            ax.plot(self.x, curve, label=name)
        ax.set(xlabel=self.x_label, ylabel=self.y_label)
        if len(self.series) > 1:
            ax.legend()
        return ax


def plot(r: Result, names: Sequence[str], ax: Any, against: str | None, notation: Notation | None) -> Any:
    """Curves of quantities; those of different kinds in panels of one Scene."""
    refuse_still(r, "a plot")
    shown = Shown(r, notation or Notation())
    x, x_label, angle = along(r, shown) if against is None else _against(r, against, shown)
    panels: dict[str, dict[str, Array]] = {}
    for name in names or [*(f"effort.{d}" for d in r.drives), *(f"load.{n}" for n in r.unknown_loads)]:
        kind = quantity(r, name).kind
        values = stepped_series(r, methodcaller("__getitem__", name))
        panels.setdefault(kind, {}).update(_parts(name, values * shown.value(kind, 1.0)))
    curves = [
        Curves(x, x_label, angle, series, label(kind, shown.unit(kind)), ", ".join(_vectors(series)))
        for kind, series in panels.items()
    ]
    if ax is None:
        scenes = [one.draw() for one in curves]
        return scenes[0] if len(scenes) == 1 else stack_scenes(scenes, title=r.mechanism.title, width=0.0)
    if len(curves) > 1:
        raise ModelError(f"{' and '.join(panels)} have different units", "give each separate axes")
    return curves[0].draw(ax)


def _against(r: Result, name: str, shown: Shown) -> tuple[Array, str, bool]:
    kind, values = quantity(r, name)
    if values.ndim > 1:
        raise ModelError(f"{name} is not a single number to plot against", f"name a component: {name}.x")
    stepped = stepped_series(r, methodcaller("__getitem__", name))
    unit = shown.unit(kind)
    return stepped * shown.value(kind, 1.0), f"{name} in {unit}", unit == "°"


def label(kind: str, unit: str) -> str:
    """'Angular speed in rad/s'."""
    word = "Torque" if kind == "moment" else kind.replace("_", " ").capitalize()
    return f"{word} in {unit}" if unit else word


def _parts(name: str, values: Array) -> dict[str, Array]:
    """Curves of a number, or of a vector's components and its magnitude."""
    if values.ndim == 1:
        return {name: values}
    if values.ndim > 2:
        raise ModelError(f"{name} is a matrix, not a curve", "plot angles or speeds")
    parts = dict(zip("xyz", values.T, strict=False)) | {"magnitude": np.linalg.norm(values, axis=-1)}
    return {f"{name}.{part}": curve for part, curve in parts.items()}


def _vectors(names: Mapping[str, Array]) -> list[str]:
    """Quantities without their components, each once."""
    first = (name for name in names if name[-2:] not in (".y", ".z"))
    return list(dict.fromkeys(name.removesuffix(".magnitude").removesuffix(".x") for name in first))


def polar(r: Result, joints: Sequence[str], axes: Axes, ax: Any, notation: Notation | None) -> Any:
    """Ends of joint forces over the cycle."""
    refuse_space(r.mechanism, "a polar diagram", "plot its components: r.plot('reaction.NAME')")
    refuse_still(r, "a polar diagram")
    for joint in joints:
        if joint not in r.joints:
            raise ModelError(f"unknown joint {joint!r}", closest(joint, list(r.joints)))
    chosen = list(joints) or [j for j in r.joints if r.mechanism.joints[j].hinge][:6]
    if ax is None:
        return polar_chart(r, chosen, axes, notation)
    shown = Shown(r, notation or Notation())
    for joint in chosen:
        x, y = polar_path(r, joint, axes, shown)[1].T
        is_polar = ax.name == "polar"
        ax.plot(*((np.arctan2(y, x), np.hypot(x, y)) if is_polar else (x, y)), label=joint)
    unit = shown.unit("force")
    if ax.name != "polar":
        ax.set(xlabel=f"Force x in {unit}", ylabel=f"Force y in {unit}", aspect="equal")
    else:
        ax.set(title=f"Force in {unit}")
    ax.legend()
    return ax


MOST_CURVES = 6
"""Curves of one plot: as many as have distinct line styles."""
REDUCED = ("peak", "mean", "rms", "norm8")
"""Reductions over the positions that are one number."""


def plot_sweep(s: Sweep, name: str, reduce: str | None, ax: Any) -> Any:
    """Curves over the cycle, for some designs if there are many; or a reduction against the values of the
    first path."""
    if reduce not in (None, *REDUCED):
        raise ModelError(f"no curve is drawn of {reduce!r}", f"there are: {', '.join(REDUCED)}")
    shown, kind = Shown(s.nominal, Notation()), s.kinds.get(name, "")
    over_cycle = reduce is None and s.status.shape[-1] > 1
    curves, names = _over_cycle(s, name) if over_cycle else _over_values(s, name, reduce or "peak")
    x, x_label, angle = _positions(s, shown) if over_cycle else _values(s, shown)
    chosen = sorted({round(k) for k in np.linspace(0, len(curves) - 1, min(len(curves), MOST_CURVES))})
    order = np.argsort(x)
    series = {names[k]: curves[k][order] * shown.value(kind, 1.0) for k in chosen}
    some = f", {len(chosen)} of {len(curves)} curves" if len(chosen) < len(curves) else ""
    title = f"{name} by {', '.join(s.paths)}{some}"
    return Curves(x[order], x_label, angle, series, label(kind, shown.unit(kind)), title).draw(ax)


def _over_cycle(s: Sweep, name: str) -> tuple[Array, list[str]]:
    """A curve and a name for each design; for a vector its magnitude."""
    values = s[name]
    values = np.linalg.norm(values, axis=-1) if values.ndim > len(s.shape) + 1 else values
    return values.reshape(-1, values.shape[-1]), [", ".join(of) for of in s.designs]


def _over_values(s: Sweep, name: str, reduce: str) -> tuple[Array, list[str]]:
    """A curve along the first path for each set of values of the others."""
    curves = s.over(name, reduce).reshape(s.shape[0], -1).T
    one = s.together or len(s.paths) == 1
    return curves, [f"{reduce} of {name}"] if one else [", ".join(of[1:]) for of in s.designs[: len(curves)]]


def _positions(s: Sweep, shown: Shown) -> tuple[Array, str, bool]:
    """Positions of the first drive if they are the same in every design, else their numbers."""
    drives = s.answers.drives.reshape(-1, *s.answers.drives.shape[-2:])
    if (drives == drives[0]).all():
        return along(s.nominal.before, shown)
    return np.arange(1.0, drives.shape[1] + 1), "position", False


def _values(s: Sweep, shown: Shown) -> tuple[Array, str, bool]:
    """Values of the first path in the reader's unit, or their numbers where they are texts."""
    path, of = s.paths[0], s.labels[s.paths[0]]
    if not isinstance(of.values[0], float):  # all of them are numbers, or all texts
        return np.arange(1.0, len(of.values) + 1), path, False
    unit = shown.unit(of.kind)
    return np.array(of.values) * shown.value(of.kind, 1.0), f"{path} in {unit}" if unit else path, unit == "°"
