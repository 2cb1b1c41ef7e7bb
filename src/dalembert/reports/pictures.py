"""The mechanism as a report shows it, in plane and space."""

from __future__ import annotations

from dalembert.reports.report_context import ReportContext
from dalembert.views import draw
from dalembert.views.paper.details import detail_scenes
from dalembert.views.paper.scene import Scene
from dalembert.views.plane.mechanism_view import mechanism_scene
from dalembert.views.question import question_scene
from dalembert.views.space.camera import ISOMETRIC
from dalembert.views.space.space_mechanism import space_mechanism_scene


def stated_picture(c: ReportContext) -> Scene:
    """The mechanism with its loads, without friction; in a question without the unknowns."""
    if c.question:
        seen = ISOMETRIC if c.r.mechanism.dimension == 3 else None
        letters = c.written.by_letters() if c.written else ()
        return question_scene(c.r, c.k, c.notation, seen, data=False, by_letters=letters)
    if c.r.mechanism.dimension == 3:
        return space_mechanism_scene(c.r, c.k, ISOMETRIC, c.notation, friction=False)
    return mechanism_scene(c.r, c.k, c.notation, friction=False)


def friction_pictures(c: ReportContext) -> list[Scene]:
    """The mechanism with its friction circles, then its pins and guides at a larger scale; in space its free bodies."""
    if c.r.mechanism.dimension == 3:
        return [draw.free_body(c.r, link, c.k + 1, c.notation) for link in c.r.links]
    if c.r.friction is None:
        return [mechanism_scene(c.r, c.k, c.notation)]
    main = mechanism_scene(c.r, c.k, c.notation, details=False)
    return [main, *detail_scenes(c.r, c.k, None, c.shown)]
