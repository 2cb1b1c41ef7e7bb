"""Drawings of a result: ``da.draw.mechanism(r)``, ``da.draw.free_body(r, "rod", at="60 deg")``, ...

Each returns a Scene with ``save``; ``at`` is a position by its number from 1, or the one nearest to a value of the
first drive; the first solved position by default.

>>> import dalembert as da
>>> from dalembert.bundled import examples
>>> r = da.dynamics(da.load(examples()["four_bar"]))
>>> polygon = da.draw.force_polygon(r, "rocker")
>>> [arrow.of for arrow in polygon.arrows()]
['rocker', 'B', 'O4']
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal

from dalembert.analysis.methods.applied_forces import full_actions
from dalembert.analysis.plane_only import refuse_space
from dalembert.analysis.result.position_lookup import PositionChoice, position_at
from dalembert.errors import ModelError
from dalembert.views import charts as _charts
from dalembert.views.both_ends import at_both_ends
from dalembert.views.formats import glb
from dalembert.views.formats.animation import Animation as Animation
from dalembert.views.formats.animation import animation_scene
from dalembert.views.formats.glb import SolidModel as SolidModel
from dalembert.views.formats.skeleton_dxf import Skeleton as Skeleton
from dalembert.views.formats.skeleton_dxf import skeleton as skeleton
from dalembert.views.not_shown import refuse_still, refuse_structure
from dalembert.views.notation import Notation as Notation
from dalembert.views.notation import Shown
from dalembert.views.paper.scene import Scene as Scene
from dalembert.views.paper.scene import stack_scenes
from dalembert.views.plane.displaced_inertia import displaced_inertia_scene
from dalembert.views.plane.force_polygons import force_chain_scene, force_polygon_scene, lines_of_action_scene
from dalembert.views.plane.free_body import components_scene, free_body_scene, free_body_scenes
from dalembert.views.plane.friction_view import friction_scene
from dalembert.views.plane.instant_centers import instant_centers_scene
from dalembert.views.plane.mechanism_view import mechanism_scene, place_title
from dalembert.views.plane.teeth_view import teeth_scene
from dalembert.views.plane.velocity_polygons import motion_polygon_scene, stands_still
from dalembert.views.question import question_scene
from dalembert.views.space.camera import CAMERAS as CAMERAS
from dalembert.views.space.camera import Camera as Camera
from dalembert.views.space.space_free_body import space_free_body_scene
from dalembert.views.space.space_mechanism import space_mechanism_scene
from dalembert.views.space.space_view import View as Sighted
from dalembert.views.space.space_view import camera_of
from dalembert.views.symbols.pair_pictures import pair_scene, pairs_scene
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.wrench import System
    from dalembert.wrench.reading import Vector

FREE_BODIES = "draw its free bodies"
"""Alternative in space to drawings that exist only in the plane."""

View = Literal[
    "mechanism", "free-bodies", "friction", "teeth", "force-polygons", "charts", "motion", "question", "all"
]


def mechanism(
    r: Result,
    at: PositionChoice = None,
    notation: Notation | None = None,
    forces: bool = False,
    camera: Sighted = None,
) -> Scene:
    """The mechanism with the field's symbols, its loads and traces.

    ``camera``, in space: isometric (default), front, side, top, (azimuth, elevation) in degrees, or a `Camera`.
    """
    seen = _camera(r, camera)

    def render(end: Result, k: int) -> Scene:
        if seen is None:
            return mechanism_scene(end, k, notation, forces)
        return space_mechanism_scene(end, k, seen, notation, forces)

    return _both_ends(r, at, notation, render)


def question(
    r: Result, at: PositionChoice = None, notation: Notation | None = None, camera: Sighted = None
) -> Scene:
    """The figure of a question: the given data, by name and value, without computed results."""
    return question_scene(r, position_at(r, at), notation, _camera(r, camera))


def free_body(
    r: Result, link: str, at: PositionChoice = None, notation: Notation | None = None, camera: Sighted = None
) -> Scene:
    """One link with everything that acts on it, to scale; in space, reactions are in their joints' axes."""
    seen = _camera(r, camera)

    def render(end: Result, k: int) -> Scene:
        if seen is None:
            return free_body_scene(end, _link(r, link), k, notation)
        return space_free_body_scene(end, _link(r, link), k, seen, notation)

    return _both_ends(r, at, notation, render)


def components(r: Result, link: str, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """Joint forces of a link along and across it."""
    refuse_space(r.mechanism, "a drawing along and across a link", FREE_BODIES)
    return _both_ends(r, at, notation, lambda end, k: components_scene(end, _link(r, link), k, notation))


def force_polygon(
    r: Result, link: str, at: PositionChoice = None, notation: Notation | None = None, case: str | None = None
) -> Scene:
    """The forces on a link head to tail; ``case`` names one source of the superposition to draw alone."""
    refuse_space(r.mechanism, "a force polygon", FREE_BODIES)
    return _both_ends(
        r, at, notation, lambda end, k: force_polygon_scene(end, _link(r, link), k, notation, case)
    )


def force_chain(
    r: Result, at: PositionChoice = None, notation: Notation | None = None, case: str | None = None
) -> Scene:
    """The polygons of all links on the sides they share, in the order of solution."""
    refuse_space(r.mechanism, "a force polygon", FREE_BODIES)
    return _both_ends(r, at, notation, lambda end, k: force_chain_scene(end, k, notation, case))


def lines_of_action(
    r: Result, link: str, at: PositionChoice = None, notation: Notation | None = None, case: str | None = None
) -> Scene:
    """Concurrency of a link's forces: their lines of action meet in one point."""
    refuse_space(r.mechanism, "a drawing of lines of action", FREE_BODIES)
    return _both_ends(
        r, at, notation, lambda end, k: lines_of_action_scene(end, _link(r, link), k, notation, case)
    )


def velocity_polygon(
    r: Result, at: PositionChoice = None, notation: Notation | None = None, drive: str | None = None
) -> Scene:
    """Velocities from one pole, with the links' images; of a ``drive`` at unit speed if one is named or none moves."""
    refuse_space(r.mechanism, "a velocity polygon", FREE_BODIES)
    refuse_structure(r, "a velocity polygon")
    which = None if drive is None else r.drives.index(_known(drive, r.drives, "drive"))
    return motion_polygon_scene(r, position_at(r, at), "velocity", notation, which)


def acceleration_polygon(r: Result, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """Accelerations from one pole, with their parts and the links' images."""
    refuse_space(r.mechanism, "an acceleration polygon", FREE_BODIES)
    refuse_structure(r, "an acceleration polygon")
    return motion_polygon_scene(r, position_at(r, at), "acceleration", notation)


def instant_centers(r: Result, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """The instant centres of every two links."""
    refuse_space(r.mechanism, "a drawing of instant centres", FREE_BODIES)
    refuse_structure(r, "a drawing of instant centres")
    return instant_centers_scene(r, position_at(r, at), notation)


def charts(r: Result, notation: Notation | None = None) -> Scene:
    """Efforts, joint forces, polar diagrams and the shaking force over the cycle."""
    refuse_still(r, "a chart")
    return stack_scenes(_charts.chart_scenes(r, notation), title=r.mechanism.title, width=270.0)


def free_bodies(
    r: Result, at: PositionChoice = None, notation: Notation | None = None, camera: Sighted = None
) -> Scene:
    """All links as free bodies, one force scale."""
    seen = _camera(r, camera)

    def render(end: Result, k: int) -> Scene:
        title = _title(r, k, "Free bodies", notation)
        if seen is None:
            return stack_scenes(free_body_scenes(end, k, notation), title=title)
        return stack_scenes([space_free_body_scene(end, n, k, seen, notation) for n in r.links], title=title)

    return _both_ends(r, at, notation, render, "Free bodies")


def force_polygons(r: Result, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """Polygons of each link, then of the chain."""
    refuse_space(r.mechanism, "a force polygon", FREE_BODIES)

    def render(end: Result, k: int) -> Scene:
        some, title = full_actions(end), _title(r, k, "Force polygons", notation)
        scenes = [force_polygon_scene(end, link, k, notation, some=some) for link in r.links]
        return stack_scenes([*scenes, force_chain_scene(end, k, notation)], title=title)

    return _both_ends(r, at, notation, render, "Force polygons")


def beside(scenes: Sequence[Scene], title: str = "", width: float = 240.0) -> Scene:
    """Drawings as panels in rows at most ``width`` mm wide."""
    return stack_scenes(scenes, title=title, width=width)


def displaced_inertia(
    r: Result, link: str, at: PositionChoice = None, notation: Notation | None = None
) -> Scene:
    """The inertia force of a link on its displaced line, with its offset h."""
    refuse_space(r.mechanism, "a displaced inertia force", FREE_BODIES)
    return displaced_inertia_scene(r, _link(r, link), position_at(r, at), notation)


def superposition(r: Result, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """Force polygons of the chain for one source at a time, then for all together."""
    refuse_space(r.mechanism, "a force polygon", FREE_BODIES)
    from dalembert.analysis.methods.superposition import superposition as split

    k = position_at(r, at)
    scenes = [force_chain_scene(r, k, notation, source) for source in split(r).sources]
    return stack_scenes(
        [*scenes, force_chain_scene(r, k, notation)], title=_title(r, k, "Superposition", notation)
    )


def force_system(
    s: System,
    at: Vector | None = None,
    notation: Notation | None = None,
    camera: Sighted = "isometric",
) -> Scene:
    """A force system of `da.wrench` with its resultant on the central axis; in the plane with its force polygon.

    ``at`` adds the force and couple at that point (m). ``camera``, in space: isometric, front, side, top,
    (azimuth, elevation) in degrees, or a `Camera`.
    """
    from dalembert.views import force_system as views

    seen = camera_of(camera)
    scenes = [views.force_system_scene(s, notation, seen)]
    if s.dimension == 2 and len(s.forces) > 1:
        scenes.append(views.force_system_polygon_scene(s, notation))
    if at is not None:
        scenes.append(views.reduced_scene(s, at, notation, seen))
    return (
        scenes[0] if len(scenes) == 1 else stack_scenes(scenes, title=s.title or "Force system", width=240.0)
    )


def machine(answer: Any, notation: Notation | None = None) -> Scene:
    """Drawing of an answer of machine design over the cycle: of `da.shaking`, `da.balance` or `da.flywheel`."""
    scene: Scene = answer.draw(notation=notation)
    return scene


def motion(r: Result, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """Velocity and acceleration polygons and instant centres; without speeds those of unit speed."""
    refuse_space(r.mechanism, "a velocity polygon", FREE_BODIES)
    refuse_structure(r, "a velocity polygon")
    k = position_at(r, at)
    scenes = [motion_polygon_scene(r, k, "velocity", notation)]
    if stands_still(r, k):
        scenes += [motion_polygon_scene(r, k, "velocity", notation, n) for n in range(1, len(r.drives))]
    else:
        scenes.append(motion_polygon_scene(r, k, "acceleration", notation))
    scenes.append(instant_centers_scene(r, k, notation))
    return stack_scenes(scenes, title=_title(r, k, "Motion", notation))


def animation(
    r: Result, notation: Notation | None = None, seconds: float = 4.0, camera: Sighted = None
) -> Animation:
    """The mechanism in motion with its forces; ``save`` writes .svg, .gif or .webp."""
    return animation_scene(r, notation, seconds, camera=_camera(r, camera))


def joint(kind: str, camera: Sighted = None) -> Scene:
    """A joint in space by its type, with its local axes and the forces and moments it carries along them."""
    return pair_scene(kind, camera_of(camera))


def joints(camera: Sighted = None) -> Scene:
    """All joints in space, those that carry least first."""
    return pairs_scene(camera_of(camera))


def solid_model(r: Result) -> SolidModel:
    """The links as solids in motion, for 3-D viewers; ``save`` writes .glb."""
    return glb.solid_model(r)


def view(
    r: Result,
    which: View = "all",
    at: PositionChoice = None,
    notation: Notation | None = None,
    camera: Sighted = None,
) -> Scene:
    """Drawings as `dalembert draw --view` writes them."""
    seen = {"question": question, "free-bodies": free_bodies, "friction": friction}
    plane = {
        "force-polygons": force_polygons,
        "motion": motion,
        "superposition": superposition,
        "teeth": teeth,
    }
    if which == "mechanism":
        return mechanism(r, at, notation, camera=camera)
    if which in seen:
        return seen[which](r, at, notation, camera)
    if which in plane:
        return plane[which](r, at, notation)
    if which == "charts":
        return charts(r, notation)
    return stack_scenes([view(r, one, at, notation, camera) for one in together(r)], title=r.mechanism.title)


def together(r: Result) -> list[View]:
    """The views that `all` shows of a result, in order."""
    out: list[View] = ["mechanism", "free-bodies"]
    out += ["force-polygons"] if r.mechanism.dimension == 2 else []
    return out + (["charts"] if len(r.status) > 2 and r.drives and r.stability is None else [])


def friction(
    r: Result, at: PositionChoice = None, notation: Notation | None = None, camera: Sighted = None
) -> Scene:
    """Friction circles with the lines of the reactions, then every pin and guide with friction at a larger scale."""
    if r.friction is None:
        raise ModelError("this mechanism has no friction to draw", "give a joint a coefficient")
    seen = _camera(r, camera)

    def render(end: Result, k: int) -> Scene:
        return friction_scene(end, k, Shown(end, notation or Notation(), k), seen)

    return _both_ends(r, at, notation, render)


def teeth(r: Result, at: PositionChoice = None, notation: Notation | None = None) -> Scene:
    """Gears in mesh: pitch and base circles, the line of action, the force of the teeth and its components."""
    refuse_space(r.mechanism, "a drawing of teeth", FREE_BODIES)
    return _both_ends(
        r, at, notation, lambda end, k: teeth_scene(end, k, Shown(end, notation or Notation(), k))
    )


def _camera(r: Result, camera: Sighted) -> Camera | None:
    """The camera of a mechanism in space, nothing in the plane."""
    if r.mechanism.dimension == 3:
        return camera_of(camera)
    if camera is not None:
        what = "a camera looks at a mechanism in space, and this one is in the plane"
        raise ModelError(what, "leave it out")
    return None


def _known(name: str, names: Sequence[str], what: str) -> str:
    """The name, if it exists."""
    if name not in names:
        raise ModelError(f"unknown {what} {name!r}", closest(name, list(names)))
    return name


def _link(r: Result, link: str) -> str:
    return _known(link, r.links, "link")


def _both_ends(
    r: Result,
    at: PositionChoice,
    notation: Notation | None,
    render: Callable[[Result, int], Scene],
    heading: str = "",
) -> Scene:
    """A drawing of the result, or of both ends where friction leaves it undetermined; the heading also gives the
    position."""
    k = position_at(r, at)
    title = _title(r, k, heading, notation) if heading else r.mechanism.title
    return at_both_ends(r, k, Shown(r, notation or Notation(), k), lambda end: render(end, k), title)


def _title(r: Result, k: int, what: str, notation: Notation | None) -> str:
    return place_title(r, k, what, Shown(r, notation or Notation(), k))
