"""Drawings at their limits: ends of vectors, least and greatest over a cycle, circles that are not filled."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.machine.members.member_table import member_table
from dalembert.views.machine.member_views import member_scenes
from dalembert.views.paper.scene import Circle, Line, Scene
from dalembert.views.space.space_view import end_on


def test_a_vector_away_from_the_eye_ends_in_a_cross_and_one_towards_it_in_a_dot() -> None:
    ring, *cross = end_on((3.0, 5.0), False, "force")
    assert isinstance(ring, Circle)
    assert all(isinstance(line, Line) for line in cross)
    (a, b), (c, d) = (line.points for line in cross if isinstance(line, Line))
    for start, end in ((a, b), (c, d)):
        assert np.add(start, end) / 2 == pytest.approx([3.0, 5.0])  # through the middle
        assert np.hypot(*np.subtract(start, (3.0, 5.0))) == pytest.approx(
            ring.radius, rel=0.01
        )  # to the ring
    assert float(np.subtract(b, a) @ np.subtract(d, c)) == pytest.approx(0.0)  # at right angles
    ring, dot = end_on((3.0, 5.0), True, "force")
    assert isinstance(dot, Circle)
    assert (dot.center, dot.radius < 0.5 * ring.radius) == ((3.0, 5.0), True)


def test_diagrams_over_a_cycle_have_the_least_the_greatest_and_the_position_of_the_largest() -> None:
    table = member_table(da.dynamics(da.load(examples()["four_bar"]), positions=7))
    shown = 0
    for s in member_scenes(table, da.Notation()):
        if "least" not in s.numbers:
            continue
        least, greatest, (name, at) = s.numbers["least"], s.numbers["greatest"], list(s.numbers.items())[-1]
        assert name.startswith("position ")
        assert (np.array(least) <= at).all()
        assert (at <= np.array(greatest)).all()
        assert np.abs(at).max() == max(np.abs(least).max(), np.abs(greatest).max())
        assert least != greatest
        shown += 1
    assert shown > 3


def test_a_circle_that_is_not_filled_shows_what_is_behind_it(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    image = pytest.importorskip("PIL.Image")
    from dalembert.views.formats.matplotlib_figure import write_figure

    middle = {}
    for role in ("friction-circle", "mark"):
        frame = Line(((-20.0, -20.0), (20.0, 20.0)), "faint")  # its ends are the picture's
        write_figure(Scene((frame, Circle((0.0, 0.0), 8.0, role))), tmp_path / "a.png", "light", 50)
        picture = np.asarray(image.open(tmp_path / "a.png").convert("L"), float)
        rows, columns = picture.shape
        middle[role] = float(
            picture[rows // 2 - 2 : rows // 2 + 2, columns // 2 + 5 : columns // 2 + 9].mean()
        )
    paper = float(picture[2, -3])
    assert middle["friction-circle"] == paper > middle["mark"] + 100
