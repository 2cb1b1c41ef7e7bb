"""`dalembert draw`: a file analysed and drawn."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from dalembert.cli.documents.position_argument import announce, solve_at
from dalembert.cli.options import (
    AT_FIRST,
    Force,
    ModelFile,
    Names,
    OfAt,
    Seen,
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
    from dalembert.model import Mechanism
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

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
        with_help("Pages of a .pdf: a4 (default), letter, or fit: one page as large as the drawing."),
    ] = None,
    camera: Seen = None,
    names: Names = False,
    question: Annotated[bool, flag("Show only the given data; nothing computed.")] = False,
    skeleton: Annotated[
        bool, flag("Write a .dxf for CAD at 1:1 in the file's unit of length, one layer per link.")
    ] = False,
    of: OfAt = AT_FIRST,
    force: Force = False,
) -> int:
    """Draw FILE to scale: the mechanism, free bodies, force polygons, charts."""
    from dalembert.views import draw

    shown = _view_for(output, view, question)
    if skeleton and output.suffix.lower() != ".dxf":
        raise ModelError(f"{output.name}: a skeleton is a DXF file", "end its name in .dxf")
    check_new(output, force)
    with progress(f"Drawing {file}"):
        m, moves, positions = of.load(file), _moves(shown, output), of.positions
        if positions is None and (shown == "charts" or moves):
            positions = _enough(m, 36 if moves else 72)
        result, at = solve_at(m, of.at, of.static, positions)
        notation = draw.Notation(links="name" if names else "number")
        left: Sequence[str] = ()
        if skeleton:
            draw.skeleton(result, at).save(output, force)
        elif output.suffix.lower() == ".glb":
            draw.solid_model(result).save(output, force)
        elif moves:
            draw.animation(result, notation, camera=camera_at(camera)).save(output, force, theme)
        else:
            scene, left = _view(result, shown, at, notation, camera)
            scene.save(output, force, theme, _paper(output, paper))
        done = announce(result, output, at)
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
}
"""Function of each command -> the examples under its help."""
