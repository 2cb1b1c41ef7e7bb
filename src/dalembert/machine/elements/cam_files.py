"""The outline of a cam as a file for its manufacture: points, or a closed polyline of a drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Array
from dalembert.core.elements.cam_curves import TURN
from dalembert.errors import ModelError
from dalembert.saving import new_file

if TYPE_CHECKING:
    from dalembert.machine.elements.cam_design import CamDesign

UNITS = {"mm": 4, "cm": 5, "m": 6, "in": 1, "ft": 2}
"""Codes of units in a DXF file."""
MOST = 1 << 17


def outline(c: CamDesign, tolerance: float) -> Array:
    """Turns (N,) of the corners of a polyline that is nowhere farther than this, m, from the outline."""
    turns = c.motion.turns(181)
    while True:
        middle = (turns[1:] + turns[:-1]) / 2
        at = c.profile(turns)
        chord = (at[1:] + at[:-1]) / 2
        off = np.hypot(*(c.profile(middle) - chord).T) > 0.9 * tolerance
        if not off.any():
            return turns[:-1]
        if len(turns) > MOST:
            raise ModelError(
                f"a tolerance of {tolerance:.3g} m needs more than {MOST} points", "make it larger"
            )
        turns = np.unique([*turns, *middle[off]])


def save_outline(
    c: CamDesign, path: str, tolerance: float, cutter: float | None, overwrite: bool = False
) -> None:
    """Writes the outline, and the path of a cutter's centre besides."""
    if not tolerance > 0:
        raise ModelError(f"the tolerance {tolerance:.6g} is not positive", "give a length in m, such as 1e-6")
    turns = outline(c, tolerance)
    curves = {"cam": c.profile(turns)}
    if cutter is not None:
        hollow = c.profile_radius(turns)
        hollow = -hollow[hollow < 0]
        if hollow.size and cutter > hollow.min():
            what = f"a cutter of {cutter * 1e3:.6g} mm does not fit the hollow of {hollow.min() * 1e3:.6g} mm"
            raise ModelError(what, "take a smaller one")
        p = c.motion.at(turns)
        curves["cutter"] = curves["cam"] + cutter * c.motion.in_cam(turns, p.normal)
    to = c.scale("file")
    scaled = {name: np.asarray(to("length", xy)) for name, xy in curves.items()}
    with new_file(path, overwrite) as at:
        if path.lower().endswith(".dxf"):
            _write_dxf(scaled, str(at), to.text("length"))
        else:
            _write_csv(scaled, str(at), to)


def _write_dxf(curves: dict[str, Array], path: str, unit: str) -> None:
    import ezdxf

    document = ezdxf.new("R2010", setup=True)
    document.header["$INSUNITS"] = UNITS.get(unit, 0)
    space = document.modelspace()
    for name, xy in curves.items():
        document.layers.add(name)
        space.add_lwpolyline(xy.tolist(), close=True, dxfattribs={"layer": name})
    document.saveas(path)


def _write_csv(curves: dict[str, Array], path: str, to: Any) -> None:
    """Angle and radius in the cam's axes, counter-clockwise, with the place of the cutter's centre beside each."""
    xy = curves["cam"]
    angle = np.arctan2(xy[:, 1], xy[:, 0])
    order = np.argsort(np.mod(angle, TURN))
    unit = to.text("length")
    heads = ["angle [deg]", f"radius [{unit}]", f"x [{unit}]", f"y [{unit}]"]
    columns = [np.degrees(np.mod(angle, TURN)), np.hypot(*xy.T), *xy.T]
    if "cutter" in curves:
        heads += [f"cutter.x [{unit}]", f"cutter.y [{unit}]"]
        columns += list(curves["cutter"].T)
    kept = order[np.r_[True, np.diff(columns[0][order]) > 1e-9]]
    rows = [",".join(heads), *(",".join(repr(float(x[k])) for x in columns) for k in kept)]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(rows) + "\n")
