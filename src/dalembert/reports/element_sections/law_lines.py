"""Laws of motion in the worked solution: each rise of a drive or a cam with its coefficients and its peaks."""

from __future__ import annotations

from collections.abc import Iterator

from dalembert.analysis.compile.elements.cam_shapes import cam_shape
from dalembert.machine.motion_law import MotionRise, programme_of, rises
from dalembert.model.drives.drives import kind_of
from dalembert.model.drives.programmes import RATES, rate_kind
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sheet import ReportSheet

HEADS = ("Curve", "b", "h", "$C_{v}$", "$C_{a}$", "$C_{j}$", "v", "a", "j")


def motion_laws(sheet: ReportSheet, c: ReportContext) -> None:
    """Tables of the rises of drives with laws, and of cams with segments; none without."""
    tables = [t for t in (*_of_drives(c), *_of_cams(c)) if t[2]]
    if not tables:
        return
    sheet.heading("Laws of motion")
    sheet.text(
        "A stroke h in a time b has the largest speed $v = C_{v} h/b$, acceleration $a = C_{a} h/b^{2}$ and "
        "jerk $j = C_{j} h/b^{3}$ inside the rise; over the position of another drive, at its speed w, b/w is the "
        "time. Where the acceleration jumps, the jerk is infinite."
    )
    for heads, caption, rows in tables:
        sheet.table(heads, rows, caption)


def _of_drives(c: ReportContext) -> Iterator[tuple[list[str], str, list[list[str]]]]:
    for name in c.r.drives:
        drive = c.r.mechanism.drives[name]
        programme = programme_of(drive)
        if programme is None:
            continue
        kind, over = kind_of(drive.freedom, ""), programme.over
        speed = float(c.r.drive_speed(over)[c.k]) if over else 1.0
        master = kind_of(c.r.mechanism.drives[over].freedom, "") if over else "time"
        of = f"Law of {name}" + (f" over {over}, at its speed in this position" if over else " over time")
        yield _table(c, kind, master, abs(speed), of, list(rises(programme)))


def _of_cams(c: ReportContext) -> Iterator[tuple[list[str], str, list[list[str]]]]:
    for name, joint in c.r.mechanism.joints.items():
        lift = joint.profile.segments if joint.outlined else None  # type: ignore[union-attr]
        if lift is None:
            continue
        carrier = cam_shape(c.r.mechanism, name).carrier
        assert carrier is not None
        speed = float(c.r.freedom(carrier.pin, "turn")[1][c.k])
        of = f"Lift of cam {name}, at its speed in this position"
        yield _table(c, lift.kind, "angle", abs(speed), of, list(rises(lift.programme)))


def _table(
    c: ReportContext, kind: str, master: str, speed: float, of: str, listed: list[MotionRise]
) -> tuple[list[str], str, list[list[str]]]:
    """Heads with units, caption and rows; ``speed`` of what the law is over."""
    shown = c.shown
    kinds = [rate_kind(kind, rate) for rate in RATES]
    units = dict(zip(("b", "h", "v", "a", "j"), (master, kind, *kinds), strict=True))
    heads = [f"{h} ({shown.unit(units[h])})" if h in units else h for h in HEADS]
    rows = []
    for x in listed:
        peaks = [
            shown.number(kind, value * abs(x.way) * (speed / x.length) ** k)
            for k, (kind, value) in enumerate(zip(kinds, x.coefficients.values(), strict=True), 1)
        ]
        places = shown.number(master, x.length), shown.number(kind, x.way)
        rows.append(
            [x.by.replace("_", " "), *places, *map(c.notation.number, x.coefficients.values()), *peaks]
        )
    return heads, of, rows
