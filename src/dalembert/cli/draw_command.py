"""`dalembert draw` and `report`: a file analysed, drawn and worked out on paper."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from dalembert.cli.options import (
    AS_USUAL,
    AT_FIRST,
    Force,
    ModelFile,
    Names,
    OfAt,
    Seen,
    Style,
    Theme,
    flag,
    output,
    with_help,
)
from dalembert.errors import ModelError
from dalembert.progress import progress
from dalembert.saving import check_new

if TYPE_CHECKING:
    from dalembert.analysis import Result
    from dalembert.arrays import Tree
    from dalembert.model import Mechanism
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

OK, SOME_NOT_OK = 0, 1
MOVING = (None, "animation", "mechanism", "all")
"""Views that an animation may show."""
PICTURES = (".svg", ".pdf", ".png", ".dxf", ".gif", ".webp", ".glb")


ViewName = Literal[
    "mechanism",
    "free-bodies",
    "force-polygons",
    "motion",
    "friction",
    "teeth",
    "charts",
    "superposition",
    "animation",
    "all",
]
VIEWS = with_help(
    "Views to draw; motion: velocity and acceleration polygons and instant centres; friction: circles, pins and "
    "guides; teeth: gears in mesh; charts: over a cycle; superposition: one load at a time; all: mechanism, "
    "free bodies, force polygons, charts (default: as many of these as one page holds)."
)


def draw(
    file: ModelFile,
    /,
    *,
    output: Annotated[
        Path,
        output(
            "File to write; its extension selects the format: .svg, .pdf, .png, .dxf; .gif or .webp for an animation; "
            ".glb for a model in motion for 3-D viewers."
        ),
    ],
    view: Annotated[ViewName | None, VIEWS] = None,
    theme: Theme = "light",
    paper: Annotated[
        Literal["a4", "letter", "fit"] | None,
        with_help("Pages of a .pdf: a4 (default), letter, or fit: one as large as the drawing."),
    ] = None,
    camera: Seen = None,
    names: Names = False,
    question: Annotated[bool, flag("Show only the given data; nothing computed.")] = False,
    of: OfAt = AT_FIRST,
    force: Force = False,
) -> int:
    """Draw FILE to scale: the mechanism, free bodies, force polygons, charts."""
    from dalembert.views import draw

    shown = _view_for(output, view, question)
    check_new(output, force)
    with progress(f"Drawing {file}"):
        m, moves, positions = of.load(file), _moves(shown, output), of.positions
        if positions is None and (shown == "charts" or moves):
            positions = _enough(m, 36 if moves else 72)
        result, at = _solve_at(m, of.at, of.static, positions)
        notation = draw.Notation(links="name" if names else "number")
        left: Sequence[str] = ()
        if output.suffix.lower() == ".glb":
            draw.solid_model(result).save(output, force)
        elif moves:
            draw.animation(result, notation, camera=camera_at(camera)).save(output, force, theme)
        else:
            scene, left = _view(result, shown, at, notation, camera)
            scene.save(output, force, theme, _paper(output, paper))
        done = _announce(result, output)
    if left:
        print(f"There is also --view {', '.join(left)}; --view all draws more pages.", file=sys.stderr)
    return done


def _view(
    r: Result, view: Any, at: str | None, notation: Notation, camera: str | None
) -> tuple[Scene, Sequence[str]]:
    """The drawing, and the views that were left out of it."""
    from dalembert.views import draw

    if view is None:
        return _first_page(r, at, notation, camera_at(camera))
    return draw.view(r, view, at, notation, camera_at(camera)), ()


def _first_page(r: Result, at: str | None, notation: Notation, camera: Any) -> tuple[Scene, list[str]]:
    """The mechanism and what else of all views has room on one A4 page; and the views there are besides."""
    from dalembert.views import draw
    from dalembert.views.paper.pages import fits

    page, left = draw.mechanism(r, at, notation, camera=camera), list[str]()
    for name in draw.together(r)[1:]:
        more = draw.beside([page, draw.view(r, name, at, notation, camera)], r.mechanism.title, 180.0)
        if fits(more):
            page = more
        else:
            left.append(name)
    left += ["friction"] if r.friction is not None else []
    plane = r.mechanism.dimension == 2
    left += ["teeth"] if plane and any(joint.TOOTHED for joint in r.mechanism.joints.values()) else []
    return page, left + (["motion"] if plane and r.drives else [])


def _paper(output: Path, paper: str | None) -> str | None:
    """The pages of a PDF, A4 by default; `fit` is one page as large as the drawing."""
    if paper is None and output.suffix.lower() == ".pdf":
        return "a4"
    return None if paper == "fit" else paper


def _view_for(output: Path, view: str | None, question: bool) -> str | None:
    """The view to draw, refused at the start if the file cannot contain it."""
    if question and view not in (None, "mechanism"):
        raise ModelError(f"--question draws the mechanism, and not {view}", "leave out --view")
    view = "question" if question else view
    if output.suffix.lower() not in PICTURES:
        raise ModelError(
            f"{output.name}: the ending names no kind of drawing", f"use one of {' '.join(PICTURES)}"
        )
    if _moves(view, output) and view not in MOVING:
        raise ModelError(
            f"{output.name}: {output.suffix} holds an animation of the mechanism, and not {view}",
            "write .svg, .pdf or .png, or ask for --view animation",
        )
    return view


def camera_at(text: str | None) -> str | tuple[float, float] | None:
    """A camera by its name, or by azimuth and elevation in degrees."""
    if text is None or "," not in text:
        return text
    try:
        azimuth, elevation = (float(part) for part in text.split(","))
    except ValueError:
        raise ModelError(f"--camera {text} is not a direction", "write --camera 30,20: degrees") from None
    return azimuth, elevation


def report(
    file: ModelFile,
    /,
    *,
    output: Annotated[
        Path, output("File to write; its extension selects the format: .pdf, .html, .tex or .txt.")
    ],
    method: Annotated[
        list[Literal["steps", "matrix", "graphical", "superposition", "virtual-work"]] | None,
        Parameter(
            negative=(), help="Methods to show, one or more (default: all); graphical only in the plane."
        ),
    ] = None,
    style: Style = AS_USUAL,
    about: Annotated[str, with_help("Joint about which moments are taken, for links that have it.")] = "",
    begin: Annotated[str, with_help("Link whose forces are solved first, as far as possible.")] = "",
    along: Annotated[str, with_help("Angle of the first axis of the sums of forces, as 30deg.")] = "0",
    of: OfAt = AT_FIRST,
    force: Force = False,
) -> int:
    """Write the worked solution of FILE, step by step, with its drawings."""
    from dalembert.reports import report as worked_out

    with progress(f"Working out {file}"):
        check_new(output, force)
        result, at = _solve_at(of.load(file), of.at, of.static, of.positions)
        worked_out(result, at, method, style.notation(), about, begin, along).save(output, force)
        return _announce(result, output)


def _announce(result: Result, output: Path) -> int:
    """Say what was written, and which positions are not ok and why; the exit status."""
    from dalembert.analysis.output.summary.printed_answer import problems_text
    from dalembert.analysis.output.summary.printed_units import print_scale

    print(f"Written: {output}", file=sys.stderr)
    if result.ok.all():
        return OK
    print(problems_text(result, print_scale(result, "file")), file=sys.stderr)
    return SOME_NOT_OK


def _solve_at(m: Mechanism, at: str | None, static: bool, positions: int | None) -> tuple[Result, str | None]:
    """The result and the position asked for; a drive's value that the file has not is gone to from its first one."""
    from dalembert.analysis import solve

    if at is None or at.strip().isdigit() or positions is not None or len(m.drives) != 1:
        return solve(m, static=static, positions=positions), at
    values = _path_to(m, at)
    if values is None:
        return solve(m, static=static), at
    return solve(_at_last_position(m, values), static=static), None


def _at_last_position(m: Mechanism, values: list[float]) -> Mechanism:
    """The mechanism at the last of some positions of its drive, in the assembly mode that leads to it."""
    from dalembert.analysis import kinematics

    path = f"drives.{next(iter(m.drives))}.position"
    r = kinematics(m.with_values({path: values}))
    changes: Tree = {path: values[-1]}
    if all(map(math.isfinite, r.point_array[-1].ravel())):
        changes["assembly"] = {link: _pose(r, link) for link in r.links}
    return m.with_values(changes)


def _pose(r: Result, link: str) -> object:
    """Pose of a link at the last position, in the form of an assembly."""
    if r.mechanism.dimension == 2:
        return float(r.angle(link)[-1])
    from dalembert.algebra import space

    x, y, z, w = (float(q) for q in space.quaternion(r.rotation(link)[-1].ravel()))
    size = math.hypot(x, y, z)
    position = [float(p) for p in r.position(link)[-1]]
    return {"position": position, "axis": [x, y, z] if size else [0, 0, 1], "angle": 2 * math.atan2(size, w)}


def _path_to(m: Mechanism, at: str) -> list[float] | None:
    """Positions in small steps from the file's only one to a value of its drive; None where the file has more."""
    import numpy as np

    from dalembert.units import file_units, quantity

    schedule = m.schedule()
    if schedule.position.shape != (1, 1) or schedule.unknown is not None:
        return None
    drive = m.drives[schedule.names[0]]
    slides = (
        not drive.turns
        if drive.freedom
        else m.joints[drive.joint or schedule.names[0]].freedoms[0] == "slide"
    )
    start = float(schedule.position[0, 0])
    end = quantity(at, "length" if slides else "angle", file_units(m.units))
    if abs(end - start) < 1e-9:
        return None
    count = 40 if slides else max(2, int(np.ceil(abs(end - start) / 0.05)) + 1)
    return [float(v) for v in np.linspace(start, end, count)]


def _moves(view: Any, output: Path) -> bool:
    """True if an animation is requested."""
    return view == "animation" or output.suffix.lower() in (".gif", ".webp", ".glb")


def _enough(m: Mechanism, count: int) -> int | None:
    """Charts and animations of a file with one position show a full turn."""
    schedule = m.schedule()
    return count if len(schedule.position) == 1 and m.drives and schedule.unknown is None else None


COMMANDS: dict[Callable[..., int], str] = {
    draw: """Examples:
  dalembert draw four_bar.yaml -o four_bar.svg
  dalembert draw four_bar.yaml --view force-polygons --at 60deg -o polygons.pdf
  dalembert draw four_bar.yaml --view charts --positions 72 -o charts.png
  dalembert draw four_bar.yaml --question -o question.svg""",
    report: """Examples:
  dalembert report four_bar.yaml -o four_bar.pdf
  dalembert report four_bar.yaml -o four_bar.html --method virtual-work --names
  dalembert report rssr.yaml -o rssr.pdf --at 30deg
  dalembert report engine.yaml -o engine.tex --at 60deg --units si --decimals 2""",
}
"""Function of each command -> the examples under its help."""
